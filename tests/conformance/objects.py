"""What a device's objects should be: by its EDS as python-canopen reads it, and by the table typed by hand."""

import configparser
import csv
import dataclasses
import pathlib

import canopen
from canopen.objectdictionary import ODVariable, datatypes

HERE = pathlib.Path(__file__).resolve().parent
PROFILES = HERE.parents[1] / "drivers" / "profiles"
SILENT = "?"  # docs/sources.md does not say

TYPES = {
    datatypes.INTEGER8: "i8",
    datatypes.INTEGER16: "i16",
    datatypes.INTEGER32: "i32",
    datatypes.INTEGER64: "i64",
    datatypes.UNSIGNED8: "u8",
    datatypes.UNSIGNED16: "u16",
    datatypes.UNSIGNED32: "u32",
    datatypes.UNSIGNED64: "u64",
    datatypes.VISIBLE_STRING: "visible string",
    datatypes.OCTET_STRING: "octet string",
    datatypes.DOMAIN: "domain",
}
PLAIN_ACCESS = {"rww": "rw", "rwr": "rw"}
# Directions of PDO: R = received by the device, T = sent by it.
MAP_OF_ACCESS = {"ro": "T", "const": "T", "wo": "R", "rww": "R", "rwr": "T", "rw": "RT"}


@dataclasses.dataclass(frozen=True)
class Expected:
    """One object. None: not known, not compared (in `low` and `high`: the type's own limit)."""

    index: int
    sub: int
    name: str
    type: str
    access: str | None
    map: str | None  # of "", "R", "T", "RT"
    default: int | str | None
    low: int | None = None
    high: int | None = None

    @property
    def text(self):
        return self.type[0] not in "iu"

    @property
    def size(self):
        return int(self.type[1:]) // 8

    @property
    def signed(self):
        return self.type[0] == "i"

    def encode(self, value):
        return (value % (1 << 8 * self.size)).to_bytes(self.size, "little")

    def decode(self, data):
        return int.from_bytes(data, "little", signed=self.signed)

    def representable(self, value):
        return self.decode(self.encode(value)) == value

    def __str__(self):
        return f"{self.index:04X}:{self.sub:02X} {self.name}"


# Of an object, in CiA 306; what else is to be said of it stands in a file beside the EDS.
EDS_KEYS = {
    *("ParameterName", "ObjectType", "DataType", "AccessType", "PDOMapping"),
    *("DefaultValue", "LowLimit", "HighLimit", "ObjFlags"),
}


def eds_path(profile):
    return PROFILES / profile / f"{profile}.eds"


def extra_path(profile):
    """Units and PDO directions, in the EDS's sections (drivers/canopen/eds.h)."""
    return PROFILES / profile / f"{profile}.extra.ini"


def dictionary(profile, node):
    """python-canopen's own reading of the EDS."""
    return canopen.import_od(str(eds_path(profile)), node)


def _map_overrides(profile):
    """Directions of PDO that AccessType cannot tell."""
    text = configparser.RawConfigParser()
    text.read(extra_path(profile), encoding="utf-8")
    return {name.lower(): text[name]["SprungMap"] for name in text.sections() if "SprungMap" in text[name]}


def _map_of(variable, override):
    if override is not None:
        return override
    return MAP_OF_ACCESS[variable.access_type] if variable.pdo_mappable else ""


def _expected(variable, override):
    return Expected(
        variable.index,
        variable.subindex,
        variable.qualname,
        TYPES[variable.data_type],
        PLAIN_ACCESS.get(variable.access_type, variable.access_type),
        _map_of(variable, override),
        variable.default,
        variable.min,
        variable.max,
    )


def from_eds(profile, node):
    """@return every object of the EDS, by (index, sub-index)."""
    overrides = _map_overrides(profile)
    found = {}
    for entry in dictionary(profile, node).values():
        single = isinstance(entry, ODVariable)
        for variable in [entry] if single else entry.values():
            section = f"{variable.index:04x}" if single else f"{variable.index:04x}sub{variable.subindex:x}"
            if variable.index >= 0x1000:  # below: dummies, which are types
                found[variable.index, variable.subindex] = _expected(variable, overrides.get(section))
    return found


def _number(text, node):
    if text in ("", SILENT):
        return None
    relative = text.startswith("$NODEID+")
    return int(text.removeprefix("$NODEID+"), 0) + (node if relative else 0)


def from_hand(profile, node):
    """@return the objects typed by hand, by (index, sub-index)."""
    with open(HERE / "objects_by_hand.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    found = {}
    for row in rows:
        if row["device"] != profile:
            continue
        index, sub = int(row["index"], 16), int(row["sub"])
        found[index, sub] = Expected(
            index,
            sub,
            "by hand",
            row["type"],
            None if row["access"] == SILENT else row["access"],
            None if row["map"] == SILENT else row["map"].replace("-", ""),
            _number(row["default"], node),
            _number(row["low"], node),
            _number(row["high"], node),
        )
    return found
