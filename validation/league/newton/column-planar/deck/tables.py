"""Tables in results/ from pictures.npz: thickness over the bed, front over time, numbers."""
import numpy as np

run = np.load("pictures.npz")
times, area, spacing = run["times"], float(run["area"]), float(run["spacing"])
half_width, height, gravity = (float(run[key]) for key in ("half_width", "height", "gravity"))
x, y = run["places"][:, :, 0], run["places"][:, :, 2]
squared_speed = np.sum(run["velocities"] ** 2, axis=2)


def thickness(x, bin_width, bins):
    """Area per length of the bed [m], each point's spread evenly over a spacing to either side."""
    edges = np.arange(-bins, bins + 1) * bin_width
    area_left_of = [np.sum(np.clip((edge - x + spacing) / (2 * spacing), 0, 1)) for edge in edges]
    both_sides = area * np.diff(area_left_of) / bin_width
    # What is spread across the symmetry plane comes back from its other side.
    return both_sides[bins:] + both_sides[:bins][::-1]


def front(profile, bin_width, least):
    """First place outwards where the thickness falls below `least` [m]."""
    k = int(np.argmax(profile < least))
    part = (profile[k - 1] - least) / (profile[k - 1] - profile[k])
    return (k - 0.5 + part) * bin_width


# The height is that of the innermost bin, a tenth of the half width.
coarse, fine = 0.1 * half_width, 0.05 * half_width
with open("results/series.csv", "w") as out:
    out.write("t,front,front_of_rows,height\n")
    for time, places in zip(times, x):
        profile = thickness(places, coarse, 60)
        fronts = [front(profile, coarse, part * half_width) for part in (0.02, 0.05)]
        row = time, *fronts, profile[0]
        out.write(",".join(f"{value:.6g}" for value in row) + "\n")
with open("results/thickness.csv", "w") as out:
    # The times are 0, 1, 2, 3 and 15 sqrt(h_0/g).
    out.write("x,start,after_1,after_2,after_3,end\n")
    bins = int(np.max(x) / fine) + 2
    profiles = [thickness(x[picture], fine, bins) for picture in (0, 4, 8, 12, -1)]
    for k in range(bins):
        row = (k + 0.5) * fine, *(profile[k] for profile in profiles)
        out.write(",".join(f"{value:.4g}" for value in row) + "\n")

# Energies are means over the points, for a unit of mass.
kinetic, potential = 0.5 * squared_speed.mean(axis=1), gravity * y.mean(axis=1)
slowest = np.sort(squared_speed, axis=1)[:, : int(0.995 * x.shape[1])]
kinetic_of_slowest = 0.5 * slowest.sum(axis=1) / x.shape[1]
at_rest = 5e-7 * (potential[0] - potential)


def first_time(moving):
    """First time after the start at which `moving` is below the kinetic energy of rest [s]."""
    rests = np.flatnonzero(moving[1:] < at_rest[1:])
    return times[rests[0] + 1] if rests.size else np.inf


# As in the case, the fastest 0.5 % of the mass count as at rest in the last picture only.
moving = np.append(kinetic[:-1], kinetic_of_slowest[-1])
innermost = thickness(x[-1], coarse, 60)[0]
top = np.max(y[-1][x[-1] < coarse]) + spacing / 2
lost = (x < 0) | (y < 0)
energy = kinetic + potential
numbers = {
    "rest_time [s]": first_time(moving),
    "rest_time_of_all [s]": first_time(kinetic),
    "rest_time_of_the_slowest_99.5_% [s]": first_time(kinetic_of_slowest),
    "height_by_top [%]": 100 * (top / innermost - 1),
    "energy_gain [%]": 100 * max(0.0, np.max(energy) - energy[0]) / potential[0],
    "particles_lost [-]": np.count_nonzero(np.any(lost, axis=0)),
}
with open("results/numbers.csv", "w") as out:
    out.write("number,value\n")
    for name, value in numbers.items():
        out.write(f"{name},{value:.7g}\n")
