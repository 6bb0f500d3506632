"""Profiles and friction of the slopes: tables.py ANGLE..., with profile.txt in each folder."""
import math
import os
import sys

D, g, rho = 0.002, 9.81, 2500.0


def windows(path):
    """Height, bulk density and velocity of every bin above the bed, window by window."""
    rows = [line.split() for line in open(path) if not line.startswith("#")]
    starts = [k for k, row in enumerate(rows) if len(row) == 3]
    for start in starts:
        bins = rows[start + 1 : start + 1 + int(rows[start][1])]
        yield [[float(row[k]) for k in (1, 3, 4)] for row in bins if float(row[1]) > 0.0]


def mean(values):
    return sum(values) / len(values)


def fit(points):
    """mu_s, mu_2, I_0 of mu_s + (mu_2 - mu_s) I/(I_0 + I) by least squares, and the misfit."""
    best = None
    for step in range(1, 400):
        I0 = 0.005 * step
        s = [I / (I0 + I) for I, _ in points]
        m = [mu for _, mu in points]
        covariance = mean([a * b for a, b in zip(s, m)]) - mean(s) * mean(m)
        slope = covariance / (mean([a * a for a in s]) - mean(s) ** 2)
        mu_s = mean(m) - slope * mean(s)
        misfit = math.sqrt(mean([(mu_s + slope * a - b) ** 2 for a, b in zip(s, m)]))
        if best is None or misfit < best[3]:
            best = mu_s, mu_s + slope, I0, misfit
    return best


def main():
    os.makedirs("results", exist_ok=True)
    points, table = [], []
    for angle in sys.argv[1:]:
        bins = zip(*windows(f"{angle}/profile.txt"))
        profile = [[mean(column) for column in zip(*rows)] for rows in bins]
        y, density, u = zip(*profile)
        bulk = sorted(density[3:8])[2]
        height = sum(density) * D / bulk
        with open(f"results/profile-{angle}.csv", "w") as out:
            out.write("y,u,phi\n")
            for row in profile:
                if row[0] < height:
                    out.write(f"{row[0]:.6g},{row[2]:.6g},{row[1] / rho:.6g}\n")
        # pressure from the weight above; tan(angle) is the friction at every height of a steady flow
        inertia = []
        for k in range(1, len(y) - 1):
            if 0.2 * height < y[k] < 0.75 * height:
                weight = (sum(density[k:]) - 0.5 * density[k]) * D
                pressure = weight * g * math.cos(math.radians(float(angle)))
                inertia.append((u[k + 1] - u[k - 1]) / (2 * D) * D / math.sqrt(pressure / rho))
        scatter = math.sqrt(mean([(each - mean(inertia)) ** 2 for each in inertia]))
        mu = math.tan(math.radians(float(angle)))
        points.append((mean(inertia), mu))
        table.append((float(angle), mu, mean(inertia), scatter, bulk / rho, height))
    with open("results/friction.csv", "w") as out:
        out.write("angle,mu,I,I_scatter,phi,height\n")
        for row in table:
            out.write(",".join(f"{value:.6g}" for value in row) + "\n")
    with open("results/law.csv", "w") as out:
        out.write("mu_s,mu_2,I_0,misfit\n" + ",".join(f"{value:.6g}" for value in fit(points)) + "\n")


if __name__ == "__main__":
    main()
