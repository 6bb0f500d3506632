"""Initial particles and settings of a plane case of DualSPHysics, and its particles over time.

`write` takes the place of GenCase: it writes NAME.xml and NAME.bi4, both as the program reads them.
A .bi4 file is a tree of items; an item has named values, arrays and further items. Every name is
a length and its letters; numbers are little-endian.
"""
import csv
import glob
import struct
import xml.etree.ElementTree as xml

import numpy as np

# codes of the types and how a value of each is packed
TYPES = {
    "text": (1, None), "bool": (2, "<i"), "int": (7, "<i"), "uint": (8, "<I"), "ullong": (10, "<Q"),
    "float": (11, "<f"), "double": (12, "<d"), "float3": (22, "<3f"), "double3": (23, "<3d"),
}


def text(letters):
    return struct.pack("<I", len(letters)) + letters.encode()


def value(name, kind, content):
    code, form = TYPES[kind]
    content = content if isinstance(content, (tuple, list)) else (content,)
    packed = text(content[0]) if form is None else struct.pack(form, *content)
    return text(name) + struct.pack("<i", code) + packed


def array(name, kind, numbers):
    packed = numbers.astype({"uint": "<u4", "float": "<f4", "float3": "<f4", "double3": "<f8"}[kind]).tobytes()
    head = text("\nARRAY") + text(name) + struct.pack("<iiII", 0, TYPES[kind][0], len(numbers), len(packed))
    return struct.pack("<I", len(head)) + head + packed


def item(name, values, arrays=(), items=()):
    values = text("\nVALUES") + struct.pack("<I", len(values)) + b"".join(values)
    head = text("\nITEM\n") + text(name) + struct.pack("<ii", 0, 0) + text("%.7E") + text("%.15E")
    head += struct.pack("<III", len(arrays), len(items), len(values))
    return struct.pack("<I", len(head)) + head + values + b"".join(arrays) + b"".join(items)


def write(name, settings, wall, normals, fluid, velocity, density):
    """Writes a case.

    settings: constants of the program by name, gravity (x, z) and `parameters`; wall, fluid: places
    (x, z) [m]; normals: from each wall particle to the wall's surface [m]; velocity: of the fluid
    along x [m/s]; density: of the fluid [kg/m3].
    """
    places = np.vstack([wall, fluid])
    count, bound = len(places), len(wall)

    def space(plane, rows):
        full = np.zeros((rows, 3))
        full[: len(plane), [0, 2]] = plane
        return full

    lowest, highest = space(places.min(axis=0)[None], 1)[0], space(places.max(axis=0)[None], 1)[0]
    constants = {key: settings[key] for key in ("dp", "h", "b", "rhop0", "gamma", "massbound", "massfluid")}
    nowhere = (0.0, 0.0, 0.0)
    values = [
        value("Piece", "uint", 0), value("Npiece", "uint", 1), value("CaseName", "text", name),
        value("Data2d", "bool", 1), value("Data2dPosY", "double", 0.0), value("NpDynamic", "bool", 0),
        value("CasePosMin", "double3", tuple(lowest)), value("CasePosMax", "double3", tuple(highest)),
        # no domain and no period yet: they follow from the settings
        value("MapPosMin", "double3", nowhere), value("MapPosMax", "double3", nowhere),
        value("PeriMode", "int", 96), value("PeriXinc", "double3", nowhere),
        value("PeriYinc", "double3", nowhere), value("PeriZinc", "double3", nowhere),
    ]
    numbers = {"CaseNp": count, "CaseNfixed": bound, "CaseNmoving": 0, "CaseNfloat": 0, "CaseNfluid": count - bound}
    values += [value(key, "ullong", number) for key, number in numbers.items()]
    values += [value(key[0].upper() + key[1:], "double", number) for key, number in constants.items()]
    moving = np.zeros((count, 3))
    moving[bound:, 0] = velocity
    arrays = [
        array("Idp", "uint", np.arange(count)),
        array("Posd", "double3", space(places, count)),
        array("Vel", "float3", moving),
        array("Rhop", "float", np.concatenate([np.full(bound, settings["rhop0"]), density])),
        array("BoundNor", "float3", space(normals, bound)),
    ]
    part = [value("Cpart", "uint", 0), value("TimeStep", "double", 0.0), value("Npok", "uint", count)]
    with open(f"{name}.bi4", "wb") as out:
        # 58 letters, a line's end and a zero; then the order of bytes and the size of counts
        out.write(f"{'#FileJBD JPartDataBi4':58}\n".encode() + bytes(5))
        out.write(item("JPartDataBi4", values, items=[item("PART_0000", part, arrays)]))

    case = xml.Element("case", app="particles.py")
    execution = xml.SubElement(case, "execution")
    branch = xml.SubElement(execution, "constants")
    gravity = settings["gravity"]
    xml.SubElement(branch, "gravity", x=f"{gravity[0]!r}", y="0", z=f"{gravity[1]!r}")
    constants |= {"data2d": "true", "data2dposy": 0, "cflnumber": 0.2}
    for key, number in constants.items():
        xml.SubElement(branch, key, value=str(number))
    branch = xml.SubElement(execution, "parameters")
    for key, number in settings["parameters"].items():
        xml.SubElement(branch, "parameter", key=key, value=str(number))
    branch = xml.SubElement(
        execution, "particles", np=str(count), nb=str(bound), nbf=str(bound), mkboundfirst="11", mkfluidfirst="1")
    xml.SubElement(branch, "fixed", mkbound="0", mk="11", begin="0", count=str(bound))
    xml.SubElement(branch, "fluid", mkfluid="0", mk="1", begin=str(bound), count=str(count - bound))
    xml.ElementTree(case).write(f"{name}.xml")


def inputs(file):
    """Numbers of a run, from rows of the table start.csv that `bagnold export` writes."""
    return {row["quantity"]: float(row["value"]) for row in csv.DictReader(open(file))}


def constants(spacing, sound_speed, density):
    """Constants of the program: water in the plane, by Wendland's kernel over 1.2 √2 spacings."""
    mass = density * spacing**2
    return {
        "dp": spacing, "h": 1.2 * 2**0.5 * spacing, "rhop0": density, "gamma": 7.0,
        "b": sound_speed**2 * density / 7.0, "massbound": mass, "massfluid": mass,
    }


def at_rest(constants, below):
    """Density [kg/m3] under the pressure `below` [Pa]."""
    return constants["rhop0"] * (1.0 + below / constants["b"]) ** (1.0 / constants["gamma"])


def pictures(folder):
    """Time [s], places x, z [m] and velocity along x [m/s] of the fluid, in each stored state."""
    with open(f"{folder}/RunPARTs.csv") as file:
        parts = csv.DictReader((line for line in file if not line.startswith("#")), delimiter=";")
        times = [float(row["TimeStep [s]"]) for row in parts]
    for number, time in enumerate(times):
        with open(f"{folder}/data/PartCsv_{number:04}.csv") as file:
            rows = csv.DictReader(file, delimiter=";")
            names = "Pos.x [m]", "Pos.z [m]", "Vel.x [m/s]"
            fluid = [[float(row[name]) for name in names] for row in rows if row["Type"] == "3"]
        yield time, *np.array(fluid).T


def thickness(x, spacing, bins):
    """Area per length of the bed [m] in bins of a spacing, each particle's spread over two."""
    edges = np.arange(-bins, bins + 1) * spacing
    left_of = [np.sum(np.clip((edge - x + spacing) / (2 * spacing), 0, 1)) for edge in edges]
    both_sides = spacing * np.diff(left_of)
    # what is spread across the back wall comes back from its other side
    return both_sides[bins:] + both_sides[:bins][::-1]
