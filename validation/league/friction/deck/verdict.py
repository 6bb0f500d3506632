"""Friction of every geometry and code beside the law of LAMMPS' slopes: results/prediction.csv, measured.csv.

On a slope the inertial number scatters between seeds, in a cell the friction: each run gives its
friction at the mean inertial number of its seeds, by the slope of the law.
"""
import csv
import re
import statistics


def laws(path):
    """Best law and draws: mu_s, mu_2, I_0."""
    names = ("static_friction", "limiting_friction", "reference_inertia")
    values = [re.findall(rf"^{name} = (.*)", open(path).read(), re.M) for name in names]
    return [tuple(map(float, law)) for law in zip(*values)]


def friction(law, inertia):
    mu_s, mu_2, I_0 = law
    return mu_s + (mu_2 - mu_s) * inertia / (I_0 + inertia)


def main():
    best, *draws = laws("law/law.toml")
    predicted, measured = [], []
    for code, name in (("lammps", "LAMMPS"), ("yade", "YADE")):
        for geometry, case in (("slope", "slope of {}°"), ("shear", "shear at I = {:.3f}")):
            with open(f"{code}-{geometry}/points.csv") as points:
                rows = list(csv.DictReader(line for line in points if not line.startswith("#")))
            settings = list(dict.fromkeys(row["run"].split()[0] for row in rows))
            for setting in settings:
                own = [row for row in rows if row["run"].split()[0] == setting]
                each = [(float(row["inertial_number [-]"]), float(row["friction [-]"])) for row in own]
                mean = statistics.mean(inertia for inertia, _ in each)
                law = friction(best, mean)
                of = case.format(setting if geometry == "slope" else mean)
                u_law = statistics.stdev(friction(draw, mean) for draw in draws)
                predicted.append([name, "local", of, "", "friction", f"{law:.5g}", f"{u_law:.2g}", 0, "", ""])
                for row, (inertia, mu) in zip(own, each):
                    at_mean = mu - friction(best, inertia) + law
                    seed = row["run"].split()[1]
                    extra = [f"{inertia:.5g}", f"{mu:.5g}", f"{float(row['solid_fraction [-]']):.5g}"]
                    measured.append([name, of, "", "friction", seed, f"{at_mean:.5g}", *extra])
    heads = {
        "prediction": "grains,law,case,aspect_ratio,quantity,value,u_input,u_numerical,lower,upper",
        "measured": "grains,case,aspect_ratio,quantity,seed,value,inertial_number,friction,solid_fraction",
    }
    for name, table in (("prediction", predicted), ("measured", measured)):
        with open(f"results/{name}.csv", "w") as out:
            out.write(heads[name] + "\n")
            csv.writer(out, lineterminator="\n").writerows(table)


if __name__ == "__main__":
    main()
