"""sprung-can-bridge against nodes of python-canopen's LocalNode, started by `sprung up` as on a robot."""

import re

import pytest

from golden import CARD_REMAP, EPOS2_REMAP, EPOS2_SETTINGS, REMAP, SETTINGS
from power_states import ENABLED, OFF
from python_robot import UP_S, Robot
from slave import CONTROL
from wire import until

HIP, KNEE = 1, 2


@pytest.fixture
def robot(request, tmp_path):
    one = Robot(request, tmp_path)
    yield one
    one.close()


@pytest.fixture(scope="module")
def healthy(request, tmp_path_factory):
    """One robot that boots well, for all that only look at it; the last of them commands it."""
    one = Robot(request, tmp_path_factory.mktemp("healthy"))
    one.start_and_wait()
    yield one
    one.close()


@pytest.fixture(scope="module")
def enduring(request, tmp_path_factory):
    """One robot, and no new process of it, through one trouble after the other."""
    one = Robot(request, tmp_path_factory.mktemp("enduring"))
    one.start_and_wait()
    one.wait_for_safety("operational")
    yield one
    one.close()


def sent_to(robot, node):
    return [bytes(f.data).hex(" ").upper() for f in robot.wire.record.since(0, 0x600 + node)]


def writes_to_pdo(requests, communication):
    def belongs(text):
        data = bytes.fromhex(text)
        return data[0] & 0xF0 == 0x20 and data[1] | data[2] << 8 in (communication, communication + 0x200)

    return [text for text in requests if belongs(text)]


def check_remap(robot, node, golden):
    requests = sent_to(robot, node)
    for what, (communication, text) in golden.items():
        wanted = [frame.strip() for frame in re.split(r"\||\n", text) if frame.strip()]
        assert writes_to_pdo(requests, communication) == wanted, what
    assert all(len(bytes.fromhex(text)) == 8 for text in requests)


def test_boot_is_the_sequence_of_the_facts_byte_for_byte(healthy):
    frames = healthy.wire.record.since(0)
    at = {
        name: next(n for n, f in enumerate(frames) if wanted(f))
        for name, wanted in {
            "reset": lambda f: f.arbitration_id == 0 and bytes(f.data) == b"\x82\x01",
            "vendor": lambda f: f.arbitration_id == 0x601 and f.data[:4] == b"\x40\x18\x10\x01",
            "map": lambda f: f.arbitration_id == 0x601 and f.data[:4] == b"\x23\x00\x18\x01",
            "start": lambda f: f.arbitration_id == 0 and bytes(f.data) == b"\x01\x01",
            "sample": lambda f: f.arbitration_id == 0x181,
        }.items()
    }
    assert at["reset"] < at["vendor"] < at["map"] < at["start"] < at["sample"]
    boot = next(
        n for n, f in enumerate(frames) if n > at["reset"] and f.arbitration_id == 0x701 and f.data == b"\0"
    )
    assert at["reset"] < boot < at["vendor"]
    check_remap(healthy, HIP, REMAP)


def test_every_setting_is_written_read_back_and_right(healthy):
    for node, drive in healthy.drives.items():
        requests = [bytes.fromhex(text) for text in sent_to(healthy, node)]
        for written, following in zip(requests, requests[1:]):
            if written[0] & 0xF0 == 0x20 and written[1:4] != b"\x40\x60\x00":
                assert following[:4] == b"\x40" + written[1:4], f"not read back: {written.hex(' ')}"
        for (index, sub), value in SETTINGS.items():
            assert any(
                r[0] & 0xF0 == 0x20 and r[1:4] == index.to_bytes(2, "little") + bytes([sub]) for r in requests
            )
            assert value is None or drive.get(index, sub) == value, f"{index:04X}:{sub:02X}"
        assert drive.get(0x1016, 1) & 0xFFFF == 2000
        assert drive.get(0x1017) > 0


def test_sync_is_answered_and_master_heartbeat_is_there(healthy):
    mark = healthy.wire.record.mark()
    assert until(lambda: len(healthy.wire.record.since(mark, 0x080)) >= 20, UP_S)
    assert len(healthy.wire.record.since(mark, 0x181)) >= 19
    master = (healthy.drives[HIP].get(0x1016, 1) >> 16) & 0x7F
    assert healthy.wire.record.wait_for_id(0x700 + master, mark) is not None


def test_commanded_robot_is_enabled_and_stopped_by_the_control_word(healthy):
    healthy.wait_for_safety("operational")
    assert all(drive.state == OFF for drive in healthy.drives.values()), "nobody asked for power"
    said = healthy.sprung("stand")
    assert until(lambda: all(d.state == ENABLED for d in healthy.drives.values()), UP_S), said
    for drive in healthy.drives.values():
        assert drive.get(0x6061) in (8, 10) and drive.get(0x6061) == drive.get(0x6060)
    setpoints = [f for f in healthy.wire.record.since(0, 0x200 + HIP)]
    assert setpoints and all(f.dlc == 7 for f in setpoints)
    healthy.sprung("estop")
    assert until(lambda: all(d.state == OFF for d in healthy.drives.values()), UP_S)
    assert healthy.wait_for_safety("disabled")["latched"]
    assert all(drive.get(CONTROL) & 0x02 == 0 for drive in healthy.drives.values())


@pytest.mark.parametrize(
    "what, prepare, words",
    [
        ("another vendor", lambda d: d.put(0x1018, 0x9B, 1), ["knee_motor", "0x1018:01", "0x9A", "0x9B"]),
        (
            "a refused object",
            lambda d: d.refuses.update({(0x6007, 0): 0x06010002}),
            ["knee_motor", "0x6007:00", "read"],
        ),
        (
            "a value out of the drive's range",
            lambda d: d.refuses.update({(0x6076, 0): 0x06090031}),
            ["knee_motor", "0x6076:00", "high"],
        ),
    ],
    ids=["identity", "abort", "range"],
)
def test_drive_that_is_not_what_robot_yaml_says_is_refused_by_name(robot, what, prepare, words):
    knee = robot.drives[KNEE]
    knee.prepare = prepare
    robot.start()
    found = robot.wait_for_safety("disabled", "drive refused")
    assert found["latched"]
    missing = [word for word in words if word.lower() not in found["detail"].lower()]
    assert not missing, f"{what}: {found['detail']}"
    assert knee.state == OFF and robot.drives[HIP].state == OFF


def test_leg_of_epos2_drives_and_an_encoder_card_boots(request, tmp_path):
    """One bus of pegasus: three EPOS2, one card."""
    leg = Robot(request, tmp_path, "pegasus")
    try:
        leg.start_and_wait()
        check_remap(leg, 1, EPOS2_REMAP)
        check_remap(leg, 4, CARD_REMAP)
        for (index, sub), value in EPOS2_SETTINGS.items():
            assert all(drive.get(index, sub) == value for drive in leg.drives.values()), (
                f"{index:04X}:{sub:02X}"
            )
        mark = leg.wire.record.mark()
        for node in (1, 2, 3, 4):
            assert leg.wire.record.wait_for_id(0x180 + node, mark) is not None
        assert all(drive.state == OFF for drive in leg.drives.values())
    finally:
        leg.close()


def stop_sending_heartbeats(drive):
    drive.node.nmt.stop_heartbeat()


@pytest.mark.parametrize(
    "break_it, repair, causes, words",
    [
        (lambda d: d.die(), lambda d: d.power_up(), {"drive silent"}, ["knee_motor"]),
        (lambda d: d.fail(0x2310), lambda d: None, {"drive fault"}, ["knee_motor", "current"]),
        (lambda d: d.power_up(), lambda d: None, {"drive silent", "drive fault"}, ["knee_motor"]),
        (
            stop_sending_heartbeats,
            lambda d: None,
            {"drive silent", "drive fault"},
            ["knee_motor", "heartbeat"],
        ),
    ],
    ids=["silent", "over-current", "reboots", "no heartbeat"],
)
def test_drive_that_fails_in_operation_stops_the_robot_by_name_until_clear(
    enduring, break_it, repair, causes, words
):
    enduring.sprung("stand")
    assert until(lambda: all(d.state == ENABLED for d in enduring.drives.values()), UP_S)
    break_it(enduring.drives[KNEE])
    assert until(lambda: enduring.drives[HIP].state == OFF, UP_S), "the healthy drive keeps its power"
    found = enduring.wait_for_safety("quick stop")
    missing = [word for word in words if word.lower() not in found["detail"].lower()]
    assert found["latched"] and found["cause"] in causes and not missing, found
    repair(enduring.drives[KNEE])
    said = enduring.sprung("clear")
    assert not enduring.wait_for_safety("operational")["latched"], said
    assert "knee_motor" in said, f"clear does not say what it did: {said}"
    assert all(drive.state == OFF for drive in enduring.drives.values()), "clear must not give power back"
    assert enduring.drives[KNEE].get(0x6007) == 2, "a drive that forgot its settings was not configured again"
