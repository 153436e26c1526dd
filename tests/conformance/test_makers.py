"""The makers' figures (makers/*.csv): that the tables are whole, that python nodes made of them are strict,
and that each simulated drive keeps to them, object by object."""

import canopen
import pytest
from canopen import SdoAbortedError

import makers
import objects
from conftest import SUMMARY
from scan import Scanner
from slave import MAP_TOO_LONG, NOT_MAPPABLE, STATE, TOO_HIGH, TOO_LOW, Node
from test_scan import COMMISSIONED, MEASURED, ORDERS

NODE = 1
NO_OBJECT, NO_SUB, READ_ONLY, WRITE_ONLY, LENGTH = 0x06020000, 0x06090011, 0x06010002, 0x06010001, 0x06070010
# Indexes and objects, counted in the makers' three lists and their SubNumbers.
COUNTS = {"gold": (166, 458), "epos2": (157, 430)}

HISTORY = "CiA 301: a history refuses everything but 0, whatever its limits"
HALF = "the maker's default maps 32 bits of a 64-bit object, which CiA 301 refuses with 06040041"
ROLE = "Elmo's guide: the node to be heard stands in bits 16..23; the file's limit leaves no room for one"
OWN_CODES = "negative codes are Elmo's own; the simulated drive has none"
FEWER = "the simulated drive has fewer of these entries"
CODES = "the file gives no limits; codes that CiA 301 and 402 do not have are refused"
SYNC = "software 0x2126 pins the SYNC to 0x80; 0x2120 gives no limits"
GAIN = "a public driver of the EPOS2: a gain is not negative (facts canopen 2.4)"
BOTH_WAYS = "0x2120 says rwr or rww, 0x2126 rww; a machine at work maps both ways (facts canopen 2.4)"

SENT_TOO = [
    (0x2078, 1),
    *((index, 0) for index in (0x2030, 0x2062, 0x206B, 0x6040, 0x6060, 0x607A, 0x60FF)),
]
RECEIVED_TOO = [
    *((index, 0) for index in (0x2080, 0x2081, 0x6065, 0x6081, 0x6083, 0x6084, 0x6085)),
    *((0x60F6, sub) for sub in (1, 2)),
    *((0x60F9, sub) for sub in (1, 2, 4, 5)),
    *((0x60FB, sub) for sub in (1, 2, 3, 4, 5)),
    *((0x6410, sub) for sub in (1, 2, 4)),
]
FEWER_ENTRIES = {(0x2071, 0, "default"): FEWER, (0x2078, 0, "default"): FEWER}

# (index, sub-index, what): why our EDS differs from the maker's there; it must, and nowhere else.
EDS_DIFFERS = {
    "gold": {
        (0x1003, 0, "high"): HISTORY,
        (0x1016, 1, "high"): ROLE,
        (0x1016, 2, "high"): ROLE,
        (0x605A, 0, "low"): OWN_CODES,
    },
    "epos2": {
        (0x1003, 0, "high"): HISTORY,
        **{(0x1005, 0, limit): SYNC for limit in ("low", "high")},
        **{(i, 0, limit): CODES for i in (0x6007, 0x605B, 0x605C, 0x605E) for limit in ("low", "high")},
        **{(0x60F6, sub, "low"): GAIN for sub in (1, 2)},
        **{(*key, "map"): BOTH_WAYS for key in SENT_TOO + RECEIVED_TOO},
        **FEWER_ENTRIES,
    },
}
# (index, sub-index, question of scan.py): why the simulated drive answers otherwise; it must.
DRIVE_DIFFERS = {
    "gold": {
        (0x1601, 1, "write back"): HALF,
        **{(0x1016, sub, "65536, beyond its limit"): ROLE for sub in (1, 2)},
        **{(0x1016, sub, "kept by refused writes"): ROLE for sub in (1, 2)},
    },
    "epos2": {
        **{(*key, "map into TPDO"): BOTH_WAYS for key in SENT_TOO},
        **{(*key, "map into RPDO"): BOTH_WAYS for key in RECEIVED_TOO},
        **FEWER_ENTRIES,
    },
}
# Of the makers' objects nothing in sprung asks for these: single ones of indexes that are there; whole ones.
NOT_SIMULATED = {
    "gold": (
        {(0x1800 + n, 4) for n in range(4)},
        """1002 1009 100A 100B 1023 1024 2020 2030 2035 2036 2045 2051 2060 207B 2081 2082 2086 2087 2090 20A0
        20B0 20FC 20FD 2201 2202 2203 2205 2206 22A0 22A1 22A3 2E06 2E07 2E10 2E15 2F00 2F05
        2F21 2F41 2F45 2F70 6062 6065 6066 6067 6068 6069 606A 606B 606D 606E 606F 6070 607B 607C
        607D 607E 607F 6081 6082 6083 6084 6085 6086 608C 608E 608F 6090 6091 6092 6096 6097 6098
        6099 609A 60B8 60B9 60BA 60BB 60BC 60BD 60C0 60C4 60C5 60C6 60E0 60E1 60E3 60E4 60E5 60F2
        60FA 60FC 60FE""",
    ),
    "epos2": (
        {(0x2071, 2), (0x2071, 3), (0x2071, 4), (0x2078, 2), (0x2078, 3), (0x2210, 3), (0x2212, 1)},
        """2002 2003 2004 2005 2006 2008 2009 200A 200C 2010 2011 2012 2013 2014 2015 2016 2017 2018 2019 201A
        201B 2023 2024 2025 2026 202C 202D 202E 2070 2074 2079 207A 207B 207D 2082 20C4 2100 2101
        2211 2213 2240 2300 2301 2302 2303 2400 2401 2410 2411 2FFF 6067 6068 606B 606D 606E 607C
        6086 6089 608A 608B 608C 608D 608E 6098 6099 609A 60C0 60C4""",
    ),
}
# Ours, and not in the makers' files: "as on the EPOS2", docs/drivers.md.
NOT_THE_MAKERS = {"gold": {(0x1005, 0), (0x100C, 0), (0x100D, 0)}, "epos2": set()}


@pytest.fixture
def scanner(device):
    one = Scanner(device.wire, device.node)
    yield one
    one.close()


class Quiet:
    """A wire that leads nowhere."""

    def __init__(self):
        self.network = canopen.Network()
        self.network.send_message = lambda *_: None

    def send(self, can_id, data=b"", remote=False):
        pass


def node_of(make, **options):
    return Node(Quiet(), NODE, makers.dictionary(make, NODE, **options), makers.VALUES[make])


def answer(node, index, sub, value, size):
    """@return the abort code of a write, 0 where it is accepted."""
    try:
        data = (value % (1 << 8 * size)).to_bytes(size, "little")
        node.node.set_data(index, sub, data, check_writable=True)
    except SdoAbortedError as error:
        return error.code
    return 0


@pytest.mark.parametrize("make", makers.MAKES)
def test_table_has_every_object_of_the_file(make):
    table = makers.expected(make, NODE)
    assert (len({index for index, _ in table}), len(table)) == COUNTS[make]
    for one in table.values():
        assert one.type in objects.TYPES.values(), one
        limits = [limit for limit in (one.low, one.high) if limit is not None]
        assert all(not one.text and one.representable(limit) for limit in limits), one
        assert limits == sorted(limits), one
        assert one.text or one.default is None or one.representable(one.default), one


@pytest.mark.parametrize("make", makers.MAKES)
def test_every_default_map_of_the_table_is_mappable_there(make):
    table = makers.expected(make, NODE)
    for (index, sub), one in table.items():
        if index & ~3 not in (0x1600, 0x1A00) or sub == 0 or not one.default:
            continue
        mapped = table[one.default >> 16, one.default >> 8 & 0xFF]
        assert ("R" if index < 0x1800 else "T") in mapped.map, f"{one}: {mapped}"


@pytest.mark.parametrize(
    "make, index, sub, value, size, code",
    [
        ("gold", 0x6007, 0, 4, 2, TOO_HIGH),
        ("gold", 0x6007, 0, -1, 2, TOO_LOW),
        ("gold", 0x6007, 0, 2, 2, 0),
        ("gold", 0x60C2, 2, -7, 1, TOO_LOW),
        ("gold", 0x2F75, 0, 0, 2, TOO_LOW),
        ("gold", 0x1016, 1, 0x7F0000 | 100, 4, TOO_HIGH),
        ("gold", 0x6041, 0, 0, 2, READ_ONLY),
        ("gold", 0x1014, 0, 0x81, 4, READ_ONLY),
        ("gold", 0x6007, 0, 2, 4, LENGTH),
        ("gold", 0x100C, 0, 0, 2, NO_OBJECT),
        ("gold", 0x1005, 0, 0x80, 4, NO_OBJECT),
        ("gold", 0x1018, 5, 0, 4, NO_SUB),
        ("epos2", 0x6410, 1, 5001, 2, TOO_HIGH),
        ("epos2", 0x6410, 5, 0, 2, TOO_LOW),
        ("epos2", 0x60C2, 1, 2, 1, TOO_HIGH),
        ("epos2", 0x2210, 1, 15, 4, TOO_LOW),
        ("epos2", 0x2210, 1, 4096, 4, 0),
        ("epos2", 0x6071, 0, 0, 2, NO_OBJECT),
        ("epos2", 0x60F9, 3, 0, 2, NO_SUB),
        ("epos2", 0x6078, 0, 0, 2, READ_ONLY),
    ],
)
def test_node_made_of_the_table_refuses_what_the_table_says(make, index, sub, value, size, code):
    assert answer(node_of(make), index, sub, value, size) == code


def test_node_does_not_read_out_what_is_for_writing():
    for make, index in (("gold", 0x2012), ("epos2", 0x20C1)):
        with pytest.raises(SdoAbortedError) as refused:
            node_of(make).node.get_data(index, 0, check_readable=True)
        assert refused.value.code == WRITE_ONLY


def test_consumer_heartbeat_of_a_gold_can_be_either():
    value = 0x7F << 16 | 100
    assert answer(node_of("gold", consumer_limit=False), 0x1016, 1, value, 4) == 0
    assert answer(node_of("gold", consumer_limit=True), 0x1016, 1, value, 4) == TOO_HIGH


@pytest.mark.parametrize(
    "make, entries, code",
    [
        ("gold", [(0x1600, 0x60710010)], 0),
        ("gold", [(0x1A00, 0x60710010)], NOT_MAPPABLE),  # rww: received only
        ("gold", [(0x1600, 0x60770010)], NOT_MAPPABLE),
        ("gold", [(0x1A00, 0x60750020)], NOT_MAPPABLE),
        ("gold", [(0x1A00, 0x60770020)], NOT_MAPPABLE),  # bits
        ("gold", [(0x1A00, 0x60C20108)], NOT_MAPPABLE),
        ("gold", [(0x1A00, 0x30300010)], NO_OBJECT),
        ("gold", [(0x1A00, 0x60C10920)], NO_SUB),
        ("epos2", [(0x1600, 0x20300010)], 0),
        ("epos2", [(0x1A00, 0x64020010)], NOT_MAPPABLE),
    ],
)
def test_node_maps_what_its_table_allows(make, entries, code):
    node = node_of(make)
    for index, entry in entries:
        assert answer(node, index, 1, entry, 4) == STATE, "the PDO is valid"
        assert answer(node, index - 0x200, 1, 1 << 31 | 0x201, 4) == 0
        assert answer(node, index, 0, 0, 1) == 0
        assert answer(node, index, 1, entry, 4) == code


def test_node_maps_no_more_than_a_frame_holds():
    node = node_of("gold")
    assert answer(node, 0x1800, 1, 1 << 31 | 0x181, 4) == 0
    for sub in (1, 2, 3):
        assert answer(node, 0x1A00, sub, 0x60640020, 4) == 0
    assert answer(node, 0x1A00, 0, 3, 1) == MAP_TOO_LONG
    assert answer(node, 0x1A00, 0, 2, 1) == 0
    assert answer(node, 0x1A00, 1, 0x60640020, 4) == STATE, "the count is not 0"


def missing_objects(make):
    entries, indexes = NOT_SIMULATED[make]
    whole = {int(index, 16) for index in indexes.split()}
    return {key for key in makers.expected(make, NODE) if key[0] in whole} | entries


def conclude(what, make, count, differences, explained):
    """@param differences {key: line}."""
    new = [line for key, line in differences.items() if key not in explained]
    SUMMARY.append(
        f"makers' figures of {make}: {what}: {count} objects, {len(new)} differences, "
        f"{len(differences.keys() & explained.keys())} explained"
    )
    assert not new, f"{len(new)} differences:\n" + "\n".join(new)
    assert not explained.keys() - differences.keys(), "explained, but not so"


def facts_of(one):
    """Limits as they act: of what is written, and the type's where none is given."""
    access = {"const": "ro"}.get(one.access, one.access)
    seen = {"type": one.type, "access": access, "map": "".join(sorted(one.map)), "default": one.default}
    if one.text or access == "ro":
        return seen
    highest = (1 << 8 * one.size - one.signed) - 1
    lowest = -highest - 1 if one.signed else 0
    low, high = (lowest if one.low is None else one.low), (highest if one.high is None else one.high)
    return seen | {"low": low, "high": high}


@pytest.mark.parametrize("make", makers.MAKES)
def test_our_eds_says_what_the_makers_says(make):
    table, ours = makers.expected(make, NODE), objects.from_eds(make, NODE)
    assert table.keys() - ours.keys() == missing_objects(make)
    assert ours.keys() - table.keys() == NOT_THE_MAKERS[make]
    differences = {}
    for key in sorted(table.keys() & ours.keys()):
        wanted, found = facts_of(table[key]), facts_of(ours[key])
        for what in wanted.keys() | found.keys():
            silent = what == "default" and wanted[what] is None
            if not silent and wanted.get(what) != found.get(what):
                line = f"{table[key]}: {what}: the maker {wanted.get(what)}, ours {found.get(what)}"
                differences[*key, what] = line
    conclude("our EDS", make, len(table.keys() & ours.keys()), differences, EDS_DIFFERS[make])


@pytest.mark.parametrize("profile", makers.MAKES)
def test_simulated_drive_keeps_its_makers_types_access_limits_and_mapping(device, scanner, profile):
    """What runs on simulated drives, a jump for one, runs under the makers' limits."""
    table, missing = makers.expected(profile, device.node), missing_objects(profile)
    assert all(scanner.read(*key)[0] in (NO_OBJECT, NO_SUB) for key in missing)
    found = {key: one for key, one in table.items() if key not in missing}
    for one in found.values():
        scanner.look(one, one.index not in MEASURED and (one.index, one.sub) not in COMMISSIONED[profile])
    scanner.silence_pdos(found)
    for one in found.values():
        scanner.touch(one, one.index in ORDERS)
        scanner.map(one)
    differences = {difference.key: difference.line for difference in scanner.differences}
    conclude("simulated drive", profile, len(found), differences, DRIVE_DIFFERS[profile])
