"""Every object of a device against its EDS, and against the table typed by hand."""

import pytest

import objects
from conftest import PROFILES, SUMMARY
from scan import Scanner

# Values are commands, not parameters: they are not written back.
ORDERS = {0x1010, 0x1011}

UPLOAD_REQUESTS = {0x40, 0x60, 0x70}
FIXED = {(0x1000, 0), (0x1018, 1), (0x1018, 2)}

# Whose value is not the EDS's default: what is set when a drive is put into a robot (robot.yaml) ...
COMMISSIONED = {
    "gold": {
        (0x1018, 3),
        (0x1018, 4),  # revision and serial number
        (0x6075, 0),
        (0x6076, 0),
        (0x6080, 0),
    },  # ratings, speed limit
    "epos2": {(0x1018, 4), (0x2210, 1), (0x6502, 0)},  # serial number, encoder pulses, modes simulated
    "encoder_card": {(0x1018, 4)},
}
# ... and what is measured: states, positions, speeds, currents, supply, time.
MEASURED = {
    0x2020,
    0x2021,
    0x2022,
    0x2027,
    0x2028,
    0x2041,
    0x2085,
    0x20F4,
    0x2100,
    0x2101,
    0x22A2,
    0x6041,
    0x6062,
    0x6063,
    0x6064,
    0x6069,
    0x606C,
    0x6077,
    0x6078,
    0x6079,
    0x60F4,
}

HISTORY = "CiA 301: a history refuses everything but 0 with 06090030, whatever its limits"

HALF = "the maker's default maps 32 bits of a 64-bit object, which CiA 301 refuses with 06040041"

# (index, sub-index, check): why the device differs from the EDS there. A simulated device must do so.
EXPLAINED = {
    "gold": {(0x1003, 0, "1, beyond its limit"): HISTORY, (0x1601, 1, "write back"): HALF},
    "epos2": {(0x1003, 0, "1, beyond its limit"): HISTORY},
    "encoder_card": {(0x1003, 0, "1, beyond its limit"): HISTORY},
}


@pytest.fixture
def scanner(device):
    one = Scanner(device.wire, device.node)
    yield one
    one.close()


def conclude(scanner, profile, what, count, must_occur):
    explained = EXPLAINED[profile]
    new = [d.line for d in scanner.differences if d.key not in explained]
    seen = {d.key for d in scanner.differences}
    SUMMARY.append(
        f"scan of {profile}: {what}: {count} objects, {scanner.transfers} transfers, {len(new)} differences, "
        f"{len(seen & explained.keys())} explained"
    )
    assert not new, f"{len(new)} differences:\n" + "\n".join(new)
    if must_occur:
        assert not explained.keys() - seen, "explained, but not so"


def scan_by_reading(device, scanner, profile, wanted):
    """Sends nothing but SDO upload requests, which is what makes it fit for a real drive."""
    mark = device.wire.record.mark()
    for one in wanted.values():
        scanner.look(one, default_is_known(device, profile, one))
    scanner.look_beside(objects.from_eds(profile, device.node))
    sent = [
        f
        for f in device.wire.record.since(mark)
        if f.arbitration_id == 0 or f.arbitration_id >> 7 == 0x600 >> 7
    ]
    assert all(f.arbitration_id != 0 and f.data[0] in UPLOAD_REQUESTS for f in sent)


def default_is_known(device, profile, wanted):
    """Of a real drive only what nobody can change: others may have set the rest."""
    if device.settings is None:
        return wanted.access == "const" or (wanted.index, wanted.sub) in FIXED
    return wanted.index not in MEASURED and (wanted.index, wanted.sub) not in COMMISSIONED[profile]


@pytest.mark.reads_only
@pytest.mark.parametrize("profile", PROFILES)
def test_every_object_of_the_eds_can_be_read_and_nothing_is_beside_it(device, scanner, profile):
    wanted = objects.from_eds(profile, device.node)
    scan_by_reading(device, scanner, profile, wanted)
    conclude(scanner, profile, "EDS, reading", len(wanted), False)


@pytest.mark.reads_only
@pytest.mark.parametrize("profile", ["epos2", "gold"])
def test_every_object_typed_by_hand_can_be_read(device, scanner, profile):
    wanted = objects.from_hand(profile, device.node)
    scan_by_reading(device, scanner, profile, wanted)
    conclude(scanner, profile, "table by hand, reading", len(wanted), False)


@pytest.mark.parametrize("profile", PROFILES)
def test_every_object_of_the_eds_keeps_its_access_length_limits_and_mapping(device, scanner, profile):
    wanted = objects.from_eds(profile, device.node)
    scanner.silence_pdos(wanted)
    for one in wanted.values():
        scanner.touch(one, one.index in ORDERS)
        scanner.map(one)
    conclude(scanner, profile, "EDS, writing", len(wanted), True)


@pytest.mark.parametrize("profile", ["epos2", "gold"])
def test_every_object_typed_by_hand_keeps_its_access_length_limits_and_mapping(device, scanner, profile):
    wanted = objects.from_hand(profile, device.node)
    scanner.silence_pdos(objects.from_eds(profile, device.node))
    for one in wanted.values():
        if one.access is not None:
            scanner.touch(one, one.index in ORDERS)
        if one.map is not None:
            scanner.map(one)
    conclude(scanner, profile, "table by hand, writing", len(wanted), False)
