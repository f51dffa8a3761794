"""Fits of logits against other programs: statsmodels for the logit, and for the logit with drivers who differ a
likelihood of its own, maximised by scipy.

Usage: calibration.py PROGRAM, the example fit_choices of the crate for calibration.
"""

import json
import subprocess
import sys
import tempfile

import numpy as np
import statsmodels.api as sm
from scipy.optimize import minimize
from scipy.special import logsumexp

DRIVERS, SECONDS = 400, 25
TRUE = np.array([-2.0, 1.26, -0.6, 0.3])
SPREAD = 0.8


def table(seed):
    """Choices of drivers who differ: ids, whether they changed, terms."""
    random = np.random.default_rng(seed)
    driver = np.repeat(np.arange(DRIVERS), SECONDS)
    terms = random.normal(size=(driver.size, TRUE.size - 1)) * [1.0, 0.5, 2.0]
    own = SPREAD * random.normal(size=DRIVERS)
    utility = TRUE[0] + terms @ TRUE[1:] + own[driver]
    return driver, (random.uniform(size=driver.size) < 1 / (1 + np.exp(-utility))).astype(int), terms


def mixed(driver, changed, terms):
    """Estimates, spread and log-likelihood with a normal intercept per driver, by Gauss and Hermite with 7 nodes."""
    nodes, weights = np.polynomial.hermite_e.hermegauss(7)
    weights = weights / weights.sum()
    sign = 2 * changed - 1

    def cost(at):
        utility = at[0] + terms @ at[1:-1]
        logs = -np.logaddexp(0, -sign[:, None] * (utility[:, None] + np.exp(at[-1]) * nodes))
        by_driver = np.zeros((DRIVERS, nodes.size))
        np.add.at(by_driver, driver, logs)
        return -logsumexp(by_driver + np.log(weights), axis=1).sum()

    start = np.append(np.zeros(TRUE.size), -0.5)
    found = minimize(cost, start, method="BFGS", options={"gtol": 1e-7})
    found = minimize(cost, found.x, method="Nelder-Mead", options={"xatol": 1e-8, "fatol": 1e-10, "maxiter": 20000})
    return found.x[:-1], np.exp(found.x[-1]), -found.fun


def main(program):
    for seed in range(3):
        driver, changed, terms = table(seed)
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            names = ",".join(f"x{number}" for number in range(terms.shape[1]))
            file.write(f"driver,changed,{names}\n")
            for row in zip(driver, changed, terms):
                file.write(f"{row[0]},{row[1]},{','.join(repr(float(it)) for it in row[2])}\n")
            file.flush()
            ours = json.loads(subprocess.run([program, file.name], check=True, capture_output=True).stdout)
        theirs = sm.Logit(changed, sm.add_constant(terms)).fit(disp=0, tol=1e-14, maxiter=100)
        logit = ours["logit"]
        np.testing.assert_allclose(logit["estimates"], theirs.params, atol=1e-6)
        np.testing.assert_allclose(logit["standard_errors"], theirs.bse, atol=1e-6)
        np.testing.assert_allclose(logit["log_likelihood"], theirs.llf, atol=1e-6)
        estimates, spread, log_likelihood = mixed(driver, changed, terms)
        np.testing.assert_allclose(ours["mixed"]["estimates"], estimates, atol=1e-4)
        np.testing.assert_allclose(ours["mixed"]["spread"], spread, atol=1e-4)
        np.testing.assert_allclose(ours["mixed"]["log_likelihood"], log_likelihood, atol=1e-4)
    print("3 tables: the logit agrees to 1e-6, the logit with drivers who differ to 1e-4")


if __name__ == "__main__":
    main(sys.argv[1])
