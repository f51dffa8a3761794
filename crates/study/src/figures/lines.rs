//! Paths in whole units, which are short text.

/// Coordinates are whole numbers of this fraction of a pixel: fine enough for print.
pub(super) const UNITS_PER_PX: f64 = 10.0;

/// Appends a line through places [px] to a path, in whole units from point to point.
pub(super) fn append(path: &mut String, line: &[(f64, f64)]) {
    let mut here = (0, 0);
    for (index, point) in line.iter().enumerate() {
        let there = ((point.0 * UNITS_PER_PX).round() as i64, (point.1 * UNITS_PER_PX).round() as i64);
        let (right, down) = (there.0 - here.0, there.1 - here.1);
        path.push(if index == 0 { 'M' } else { 'l' });
        path.push_str(itoa::Buffer::new().format(right));
        // A minus sign separates as well as a space does.
        if down >= 0 {
            path.push(' ');
        }
        path.push_str(itoa::Buffer::new().format(down));
        here = there;
    }
}

/// The attribute that turns units into pixels.
pub(super) fn in_px() -> String {
    format!("transform=\"scale({})\"", 1.0 / UNITS_PER_PX)
}
