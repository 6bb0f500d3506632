#!/usr/bin/env python3
"""Ends of intervals on the exact Herschel-Bulkley film by SciPy's own profile likelihood, beside Bagnold's.

    cargo test --test suite intervals_for_comparison -- --ignored --nocapture | python3 tests/calibration/profile.py

Nothing is shared with Bagnold but the data: the film is written anew, the other parameters are minimised by
scipy.optimize.least_squares from several starts, the end is found by brentq.
"""
import json
import sys

import numpy as np
from scipy.optimize import brentq, least_squares
from scipy.stats import chi2

HEIGHT, SLOPE, GRAVITY, DENSITY = 0.05, 0.3, 9.81, 1300.0
NOISE, COUNT = 0.03, 15
BOUNDS = [(1.0, 150.0), (0.2, 80.0), (0.2, 1.5)]
TRUTH = (60.0, 4.0, 0.6)
y = HEIGHT * np.arange(1, COUNT + 1) / COUNT
FORCE = DENSITY * GRAVITY * np.sin(SLOPE)


def velocity(parameters):
    stress, consistency, index = parameters
    edge = HEIGHT - stress / FORCE
    plug = index / (index + 1) * (FORCE * edge / consistency) ** (1 / index) * edge
    return plug * (1 - np.clip(1 - y / edge, 0, None) ** (1 + 1 / index))


def profile(data, which=None, value=None, starts=()):
    free = [k for k in range(3) if k != which]

    def residuals(x):
        parameters = np.array([value] * 3, dtype=float)
        parameters[free] = x
        return (velocity(parameters) - data) / (NOISE * velocity(TRUTH))

    lower, upper = np.array([BOUNDS[k] for k in free]).T
    best = None
    for start in starts:
        x0 = np.clip(np.array(start)[free], lower + 1e-9, upper - 1e-9)
        fit = least_squares(residuals, x0, bounds=(lower, upper), xtol=1e-12, ftol=1e-12, gtol=1e-12, x_scale=upper - lower)
        if best is None or fit.cost < best.cost:
            best = fit
    point = np.array([value] * 3, dtype=float)
    point[free] = best.x
    return 2 * best.cost, point


def interval(data, which, least, best):
    limit, ends = chi2.ppf(0.95, 1), []
    for bound in BOUNDS[which]:
        rise = lambda value: profile(data, which, value, [best, TRUTH, (30, 8, 0.5), (90, 2, 0.8)])[0] - least - limit
        ends.append(bound if rise(bound) <= 0 else brentq(rise, best[which], bound, xtol=1e-6))
    return ends


worst = 0.0
for line in sys.stdin:
    if not line.startswith("{"):
        continue
    given = json.loads(line)
    data = np.array(given["data"])
    least, best = profile(data, starts=[TRUTH, (30, 8, 0.5), (90, 2, 0.8)])
    print(f"seed {given['seed']}: least chi squared {given['chi_squared']:.4f}, SciPy {least:.4f}")
    for k, name in enumerate(["yield stress", "consistency", "flow index"]):
        (a, b), (lower, upper) = given["intervals"][k], BOUNDS[k]
        own = [lower * (upper / lower) ** u if k == 1 else lower + u * (upper - lower) for u in (a, b)]
        exact = interval(data, k, least, best)
        off = max(abs(own[0] - exact[0]), abs(own[1] - exact[1])) / (exact[1] - exact[0])
        worst = max(worst, off)
        print(f"  {name}: {own[0]:.4f} to {own[1]:.4f}, SciPy {exact[0]:.4f} to {exact[1]:.4f}: off by {100 * off:.1f} % of the width")
print(f"worst {100 * worst:.1f} % of the width")
sys.exit(worst > 0.1)
