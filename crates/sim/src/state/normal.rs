//! The inverse of the normal distribution function.
//!
//! Wichura (1988), Algorithm AS 241: The percentage points of the normal distribution, Applied Statistics 37, 477–484,
//! its variant with sixteen digits.

/// Half the width of the middle, where the first ratio holds.
const MIDDLE: f64 = 0.425;
/// Centre of the first ratio's argument.
const MIDDLE_SQUARED: f64 = 0.180_625;
/// Where the far tail begins, in √(−ln p).
const FAR: f64 = 5.0;
/// Centre of the near tail's argument.
const NEAR_CENTRE: f64 = 1.6;

/// Coefficients of the numerators and denominators, from the constant term on.
const MIDDLE_RATIO: [[f64; 8]; 2] = [
    [
        3.387_132_872_796_366_5,
        133.141_667_891_784_38,
        1_971.590_950_306_551_3,
        13_731.693_765_509_46,
        45_921.953_931_549_87,
        67_265.770_927_008_7,
        33_430.575_583_588_13,
        2_509.080_928_730_122_7,
    ],
    [
        1.0,
        42.313_330_701_600_91,
        687.187_007_492_057_9,
        5_394.196_021_424_751,
        21_213.794_301_586_597,
        39_307.895_800_092_71,
        28_729.085_735_721_943,
        5_226.495_278_852_854,
    ],
];
const NEAR_RATIO: [[f64; 8]; 2] = [
    [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        0.241_780_725_177_450_6,
        0.022_723_844_989_269_184,
        7.745_450_142_783_414e-4,
    ],
    [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        0.689_767_334_985_1,
        0.148_103_976_427_480_08,
        0.015_198_666_563_616_457,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
];
const FAR_RATIO: [[f64; 8]; 2] = [
    [
        6.657_904_643_501_103,
        5.463_784_911_164_114,
        1.784_826_539_917_291_3,
        0.296_560_571_828_504_87,
        0.026_532_189_526_576_124,
        0.001_242_660_947_388_078_4,
        2.711_555_568_743_487_6e-5,
        2.010_334_399_292_288_1e-7,
    ],
    [
        1.0,
        0.599_832_206_555_888,
        0.136_929_880_922_735_8,
        0.014_875_361_290_850_615,
        7.868_691_311_456_133e-4,
        1.846_318_317_510_054_8e-5,
        1.421_511_758_316_446e-7,
        2.044_263_103_389_939_8e-15,
    ],
];

/// The number that a standard normal variable stays below with probability `p`, 0 < p < 1.
pub fn quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= MIDDLE {
        return q * ratio(&MIDDLE_RATIO, MIDDLE_SQUARED - q * q);
    }
    let r = libm::sqrt(-libm::log(p.min(1.0 - p)));
    let distance = if r <= FAR { ratio(&NEAR_RATIO, r - NEAR_CENTRE) } else { ratio(&FAR_RATIO, r - FAR) };
    distance.copysign(q)
}

fn ratio([numerator, denominator]: &[[f64; 8]; 2], x: f64) -> f64 {
    let polynomial = |terms: &[f64; 8]| terms.iter().rev().fold(0.0, |sum, term| sum * x + term);
    polynomial(numerator) / polynomial(denominator)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_printed_tables() {
        for (p, expected) in [
            (0.5, 0.0),
            (0.975, 1.959_963_984_540_054),
            (0.95, 1.644_853_626_951_472_2),
            (0.001, -3.090_232_306_167_813),
            (1e-12, -7.034_483_825_301_131),
        ] {
            assert!((quantile(p) - expected).abs() < 1e-12, "{p}: {}", quantile(p));
        }
    }

    #[test]
    fn it_inverts_the_distribution_function() {
        for exponent in -40..0 {
            for p in [libm::exp2(f64::from(exponent)), 1.0 - libm::exp2(f64::from(exponent.max(-20)))] {
                let back = 0.5 * libm::erfc(-quantile(p) / core::f64::consts::SQRT_2);
                assert!((back / p - 1.0).abs() < 1e-12, "{p}: {back}");
            }
        }
    }
}
