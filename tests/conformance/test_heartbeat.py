"""Supervision both ways (facts canopen 1.2, 2.6): heartbeats, node and life guarding, and the way back."""

import pytest

from conftest import PROFILES
from power_states import ENABLED, FAULT, FAULT_RESET, MASTER, OFF, QUICK_STOP, lose_heartbeat
from wire import TIMEOUT_S, until

DRIVES = ["gold", "epos2"]
LOST = bytes.fromhex("30 81")


@pytest.mark.parametrize("profile", PROFILES)
def test_heartbeat_comes_at_its_rate_and_tells_the_state(device, profile):
    mark = device.wire.record.mark()
    device.sdo[0x1017].raw = 20
    beats = until(lambda: (b := device.wire.record.since(mark, 0x700 + device.node)) and len(b) > 10 and b)
    assert beats
    # Not too often; rarer only where this machine was busy with something else.
    assert beats[10].timestamp - beats[0].timestamp > 0.5 * 10 * 0.020
    for command, state in ((0x01, 0x05), (0x02, 0x04), (0x80, 0x7F)):
        mark = device.wire.record.mark()
        device.nmt(command)
        told = device.wire.record.wait_for(
            lambda f, state=state: f.arbitration_id == 0x700 + device.node and f.data[0] == state, mark
        )
        assert told is not None, f"state {state:#04x} was never told"
    device.sdo[0x1017].raw = 0
    mark = device.wire.record.mark()
    assert device.wire.record.wait_for_id(0x700 + device.node, mark, 0.1) is None


@pytest.mark.parametrize("profile", DRIVES)
@pytest.mark.parametrize("option, states", [(0, {ENABLED}), (1, {FAULT}), (2, {OFF}), (3, {QUICK_STOP, OFF})])
def test_lost_master_is_an_emergency_and_0x6007_says_what_becomes_of_the_power(
    device, power, profile, option, states
):
    device.nmt(0x01)
    power.go(ENABLED)
    emergency, last_heard = lose_heartbeat(device, option, 100)
    assert bytes(emergency.data[:2]) == LOST
    assert emergency.data[2] & 0x11 == 0x11  # communication, generic
    # The watch runs by the drive's clock: never early. Late only as far as this machine is.
    assert 0.09 < emergency.timestamp - last_heard < TIMEOUT_S
    until(lambda: power.state() in states)
    assert power.settled() in states
    assert device.sdo[0x1003][1].raw & 0xFFFF == 0x8130
    assert device.sdo[0x1001].raw & 0x11 == 0x11


@pytest.mark.parametrize("profile", DRIVES)
def test_heartbeats_that_keep_coming_keep_the_drive_quiet(device, profile):
    device.sdo[0x1016][1].raw = MASTER << 16 | 400
    mark = device.wire.record.mark()
    task = device.wire.network.send_periodic(0x700 + MASTER, b"\x05", 0.02)
    try:
        assert device.wire.record.wait_for_id(0x80 + device.node, mark, 0.8) is None
    finally:
        task.stop()
    assert device.wire.record.wait_for_id(0x80 + device.node, mark) is not None


@pytest.mark.parametrize("profile", DRIVES)
def test_other_nodes_heartbeats_do_not_count(device, profile):
    device.sdo[0x1016][1].raw = MASTER << 16 | 100
    mark = device.wire.record.mark()
    device.wire.send(0x700 + MASTER, b"\x05")
    task = device.wire.network.send_periodic(0x700 + MASTER - 1, b"\x05", 0.02)
    try:
        assert device.wire.record.wait_for_id(0x80 + device.node, mark) is not None
    finally:
        task.stop()


@pytest.mark.parametrize("profile", DRIVES)
def test_way_back_is_reset_communication_then_fault_reset(device, power, profile):
    device.nmt(0x01)
    power.go(ENABLED)
    lose_heartbeat(device, 1)
    assert power.reaches(FAULT)
    mark = device.wire.record.mark()
    device.reset_communication_after_loss()
    power.command(0)
    power.command(FAULT_RESET)
    assert power.reaches(OFF)
    told = device.wire.record.wait_for(
        lambda f: f.arbitration_id == 0x80 + device.node and bytes(f.data[:3]) == b"\0\0\0", mark
    )
    assert told is not None, "no emergency 0000: error reset"
    assert device.sdo[0x1001].raw == 0
    power.go(ENABLED)


@pytest.mark.parametrize("profile", ["epos2"])
def test_fault_reset_before_reset_communication_is_in_vain(device, power, profile):
    """As an EPOS4 was seen to behave (facts canopen 2.6); that an EPOS2 does is unverified."""
    device.nmt(0x01)
    power.go(ENABLED)
    lose_heartbeat(device, 1)
    assert power.reaches(FAULT)
    power.command(0)
    power.command(FAULT_RESET)
    assert power.settled() == FAULT


@pytest.mark.parametrize("profile", DRIVES)
def test_guarding_answers_toggle_and_tell_the_state(device, profile):
    device.sdo[0x1017].raw = 0

    def guard():
        mark = device.wire.record.mark()
        device.wire.send(0x700 + device.node, remote=True)
        answer = device.wire.record.wait_for_id(0x700 + device.node, mark)
        return None if answer is None else answer.data[0]

    assert [guard(), guard(), guard()] == [0x7F, 0xFF, 0x7F]
    device.nmt(0x01)
    assert [guard(), guard()] == [0x85, 0x05]
    device.reset(0x82)
    assert guard() == 0x7F


@pytest.mark.parametrize("profile", DRIVES)
def test_life_guarding_ends_when_the_master_stops_asking(device, profile):
    device.sdo[0x100C].raw = 50
    device.sdo[0x100D].raw = 2
    mark = device.wire.record.mark()
    assert (
        device.wire.record.wait_for_id(0x80 + device.node, mark, 0.2) is None
    )  # begins with the first question
    task = device.wire.network.send_periodic(0x700 + device.node, b"", 0.02, True)
    task.stop()
    emergency = device.wire.record.wait_for_id(0x80 + device.node, mark)
    assert emergency is not None and bytes(emergency.data[:2]) == LOST
