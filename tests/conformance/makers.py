"""The makers' own object dictionaries: figures typed from their EDS files into makers/*.csv, which say from
where. Nothing here comes from our EDS files."""

import csv

import canopen
from canopen.objectdictionary import ODRecord, ODVariable

import objects

MAKES = ("gold", "epos2")
CONSUMER_HEARTBEAT = 0x1016
# [DeviceInfo] of the same files: what stands in 0x1018.
IDENTITY = {
    "gold": {(0x1018, 1): 0x9A, (0x1018, 2): 0x00030923, (0x1018, 3): 0x000103F6, (0x1018, 4): 1},
    "epos2": {(0x1018, 1): 0xFB, (0x1018, 2): 0x63220000, (0x1018, 3): 0x21200000, (0x1018, 4): 1},
}
# The files say nothing of these: CiA 402's bits of the modes that each make has (facts canopen 2.3, 3; [U]
# which of them a given firmware reports), and a supply.
VALUES = {
    "gold": {**IDENTITY["gold"], (0x6502, 0): 0x3ED, (0x6079, 0): 48000},
    "epos2": {**IDENTITY["epos2"], (0x1000, 0): 0x00020192, (0x6502, 0): 0x65},
}
_EMPTY = {"visible string": "", "octet string": b"", "domain": b""}
_CODES = {name: code for code, name in objects.TYPES.items()}


def rows(make):
    with open(objects.HERE / "makers" / f"{make}.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def _number(text, node):
    if not text:
        return None
    return int(text.removeprefix("$NODEID+"), 0) + (node if text.startswith("$NODEID") else 0)


def _variable(row, node):
    index, sub = int(row["index"], 16), int(row["sub"])
    variable = ODVariable(f"{index:04X}:{sub:02X}", index, sub)
    variable.data_type = _CODES[row["type"]]
    variable.access_type = row["access"]
    variable.pdo_mappable = row["map"] == "1"
    variable.min, variable.max = _number(row["low"], node), _number(row["high"], node)
    variable.default = _number(row["default"], node)
    if variable.default is None:  # every object of a drive has some value
        variable.default = _EMPTY.get(row["type"], max(0, variable.min or 0))
    return variable


def dictionary(make, node, consumer_limit=True):
    """@param consumer_limit the Gold's file allows 0..65535 in 0x1016, though the node that is to be heard
    stands in bits 16..23 by CiA 301 and by Elmo's own guide. False: as the guide has it."""
    found = canopen.ObjectDictionary()
    variables = [_variable(row, node) for row in rows(make)]
    records = {variable.index for variable in variables if variable.subindex != 0}
    for index in sorted({variable.index for variable in variables}):
        members = [variable for variable in variables if variable.index == index]
        if index == CONSUMER_HEARTBEAT and not consumer_limit:
            for member in members[1:]:
                member.max = None
        found.add_object(_record(index, members) if index in records else members[0])
    return found


def _record(index, members):
    record = ODRecord(f"{index:04X}", index)
    for member in members:
        record.add_member(member)
    return record


def expected(make, node):
    """@return what a scan must find, by (index, sub-index)."""
    found = {}
    for row in rows(make):
        index, sub = int(row["index"], 16), int(row["sub"])
        found[index, sub] = objects.Expected(
            index,
            sub,
            "by its maker",
            row["type"],
            objects.PLAIN_ACCESS.get(row["access"], row["access"]),
            objects.MAP_OF_ACCESS[row["access"]] if row["map"] == "1" else "",
            _number(row["default"], node),
            _number(row["low"], node),
            _number(row["high"], node),
        )
    return found
