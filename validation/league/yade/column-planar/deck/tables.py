"""Thickness over the bed and front over time from the pictures.

tables.py HALF_WIDTH HEIGHT [BINS], where BINS is the largest number of bins.
"""
import glob
import os
import re
import sys

half_width, height = float(sys.argv[1]), float(sys.argv[2])
bin_width = 0.05 * half_width


def read(path):
    lines = open(path).read().splitlines()
    heading = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    return float(lines[1]), [[float(word) for word in line.split()] for line in lines[heading + 1 :]]


def thickness(grains, bulk_density, bins):
    """Area per length of the bed [m], each grain's spread evenly over its diameter."""
    area = [0.0] * bins
    for x, radius, mass in grains:
        left, right = max(x - radius, 0.0), x + radius
        for k in range(int(left / bin_width), min(int(right / bin_width), bins - 1) + 1):
            part = min(right, (k + 1) * bin_width) - max(left, k * bin_width)
            area[k] += mass / bulk_density * part / (right - left)
    return [each / bin_width for each in area]


def front(profile, least):
    """First place outwards where the thickness falls below `least` [m]."""
    for k in range(1, len(profile)):
        if profile[k] < least:
            part = (profile[k - 1] - least) / (profile[k - 1] - profile[k])
            return (k - 0.5 + part) * bin_width
    return len(profile) * bin_width


paths = sorted(glob.glob("grains.*.txt"), key=lambda path: int(re.findall(r"\d+", path)[-1]))
pictures = [read(path) for path in paths]
# the column of the start fills its half width to its height
bulk_density = sum(grain[2] for grain in pictures[0][1]) / (half_width * height)
farthest = max(grain[0] + grain[1] for _, grains in pictures for grain in grains)
most_bins = int(sys.argv[3]) if len(sys.argv) > 3 else 200
bins = min(int(farthest / bin_width) + 2, most_bins)
profiles = [(time, thickness(grains, bulk_density, bins)) for time, grains in pictures]

os.makedirs("results", exist_ok=True)
with open("results/series.csv", "w") as out:
    out.write("t,front,front_of_rows,height\n")
    for time, profile in profiles:
        # the height is that of the innermost tenth of the half width
        inner = (profile[0] + profile[1]) / 2
        row = time, front(profile, 0.02 * half_width), front(profile, 0.05 * half_width), inner
        out.write(",".join(f"{value:.6g}" for value in row) + "\n")
with open("results/thickness.csv", "w") as out:
    # at 0, 1, 2, 3 and 8 sqrt(h_0/g)
    out.write("x,start,after_1,after_2,after_3,end\n")
    for k in range(bins):
        row = [(k + 0.5) * bin_width] + [profiles[picture][1][k] for picture in (0, 4, 8, 12, -1)]
        out.write(",".join(f"{value:.6g}" for value in row) + "\n")
print(f"bulk density {bulk_density:.1f} kg/m3, {len(pictures[0][1])} grains")
