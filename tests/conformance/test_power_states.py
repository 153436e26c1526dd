"""CiA 402 (facts canopen 2.1-2.3): every control word in every state, fault reset, modes, status words."""

import pytest

from conftest import SUMMARY
from pdos import configure, silence
from power_states import (
    COMMAND,
    ENABLED,
    EPOS2_WORDS,
    FAULT,
    FAULT_RESET,
    NEXT,
    OFF,
    ON,
    QUICK_STOP,
    READY,
    BySdo,
    lose_heartbeat,
)
from wire import TIMEOUT_S, until

DRIVES = ["gold", "epos2"]
MODES = {"gold": [8, 10], "epos2": [-3, -1]}
# Mode, set-point of torque or current, and a speed 0x606C that says "it moves": in counts/s and in rpm.
MOVING = {"gold": (10, 0x6071, 300, 100_000), "epos2": (-3, 0x2030, 1500, 50)}
UNKNOWN_MODE = {"gold": 2, "epos2": 8}


@pytest.mark.parametrize("profile", DRIVES)
@pytest.mark.parametrize("state", [OFF, READY, ON, ENABLED, FAULT])
def test_every_control_word_leads_where_the_table_says(device, power, profile, state):
    wrong = []
    for word, command in COMMAND.items():
        if state != FAULT or word == 0:
            power.go(state)
        expected = NEXT[state].get(command, state)
        power.command(word)
        # A motor at rest has nothing to brake: quick stop may be over at once.
        good = {expected, OFF} if expected == QUICK_STOP else {expected}
        until(lambda good=good: power.state() in good)
        if power.settled() not in good:
            wrong.append(f"{word:#06x} ({command}): expected {expected}, found {power.state()}")
    assert not wrong, f"from {state}:\n" + "\n".join(wrong)


@pytest.mark.parametrize("profile", DRIVES)
def test_fault_is_left_by_a_rising_edge_of_bit_7_only(device, power, profile):
    power.command(FAULT_RESET)
    power.fail()
    device.reset_communication_after_loss()
    assert power.settled() == FAULT
    power.command(FAULT_RESET | 0x0F)  # bit 7 was 0: the edge; its other bits command nothing
    assert power.reaches(OFF)


@pytest.mark.parametrize("profile", DRIVES)
def test_fault_reset_bit_that_was_set_all_the_time_is_no_edge(device, power, profile):
    power.go(ENABLED)
    power.command(FAULT_RESET | 0x0F)
    assert power.settled() == ENABLED  # no command is in such a word
    lose_heartbeat(device, 1)
    assert power.reaches(FAULT)
    device.reset_communication_after_loss()
    power.command(FAULT_RESET)
    assert power.settled() == FAULT
    power.command(0)
    power.command(FAULT_RESET)
    assert power.reaches(OFF)


@pytest.mark.parametrize("profile", DRIVES)
@pytest.mark.parametrize("pdo", [False, True], ids=["sdo", "pdo"])
def test_python_canopens_own_402_node_brings_the_drive_up_and_down(device, profile, pdo):
    silence(device)
    remote = device.remote
    for name in ("TIMEOUT_SWITCH_STATE_SINGLE", "TIMEOUT_SWITCH_STATE_FINAL", "TIMEOUT_CHECK_TPDO"):
        setattr(remote, name, TIMEOUT_S)
    if pdo:
        configure(remote.tpdo[1], [0x6064, 0x6041], 1, 0, device.node, True)
        configure(remote.rpdo[1], [0x6040], 255, 0, device.node, False)
        configure(remote.rpdo[2], [0x6060], 255, 1, device.node, False)
    remote.setup_402_state_machine()
    remote.nmt.state = "OPERATIONAL"
    device.wire.network.sync.start(0.005)
    try:
        for state in (READY, ON, ENABLED, ON, READY, OFF, ENABLED, OFF):
            remote.state = state
            assert remote.state == state
    finally:
        device.wire.network.sync.stop()


@pytest.mark.parametrize("profile", DRIVES)
def test_mode_counts_when_its_display_confirms_it(device, power, profile):
    for state in (OFF, ENABLED):
        power.go(state)
        for mode in [*MODES[profile], *MODES[profile]]:
            device.sdo[0x6060].raw = mode
            assert until(lambda mode=mode: device.sdo[0x6061].raw == mode)
    try:
        device.sdo[0x6060].raw = UNKNOWN_MODE[profile]
    except Exception as error:
        assert error.code in (0x06090030, 0x06090031), error
    power.settled()
    assert device.sdo[0x6061].raw == MODES[profile][-1]


@pytest.mark.parametrize("profile", ["epos2"])
def test_status_words_are_those_of_the_table(device, power, profile):
    """Seen by a TPDO on every change; start and not ready, which come before operational, by SDO."""
    words = set()
    silence(device)
    configure(device.remote.tpdo[1], [0x6041], 255, 0, device.node, True, inhibit=0)
    mark = device.wire.record.mark()
    device.nmt(0x01)
    # The word on entering operational. A drive that finds the next command beside the NMT one skips it.
    assert device.wire.record.wait_for_id(0x180 + device.node, mark) is not None
    power.fail()
    device.reset_communication_after_loss()
    power.command(0)
    power.command(FAULT_RESET)
    assert power.reaches(OFF)
    words |= {int.from_bytes(f.data, "little") for f in device.wire.record.since(mark, 0x180 + device.node)}
    device.reset()
    while (word := device.sdo[0x6041].raw) & 0x6F != 0x40:
        words.add(word)
    words = {word & 0x417F for word in words}
    assert words <= set(EPOS2_WORDS.values()), [f"{word:#06x}" for word in sorted(words)]
    seen = [name for name, word in EPOS2_WORDS.items() if word in words]
    SUMMARY.append(f"epos2: {len(seen)} of {len(EPOS2_WORDS)} status words seen: {', '.join(seen)}")
    assert {OFF, READY, ON, "refresh", "measure init", ENABLED, FAULT} <= set(seen), seen


@pytest.mark.parametrize("profile", DRIVES)
def test_quick_stop_of_a_moving_motor_is_shown_and_ends_without_power(own_bench, own_device, profile):
    """The plant moves once every drive has answered a SYNC: a simulation of its own, to disturb none."""
    device, power = own_device, BySdo(own_device)
    mode, set_point, value, fast = MOVING[profile]
    power.command(FAULT_RESET)  # an EPOS2 comes up in fault
    assert power.reaches(OFF)
    silence(device)
    event = {"gold": 1}.get(profile)  # a Gold's does not come on change
    configure(device.remote.tpdo[1], [0x6041], 255, 0, device.node, True, event=event)
    own_bench.start_cycles()

    def moves():
        device.wire.sync()
        return abs(device.sdo[0x606C].raw) > fast

    def words_of_a_stop(torque):
        power.go(ENABLED)
        device.sdo[0x6060].raw = mode
        device.sdo[set_point].raw = torque
        assert until(moves), "a torque moves nothing"
        mark = device.wire.record.mark()
        power.command(2)
        assert power.reaches(OFF)

        def words():
            return [int.from_bytes(f.data, "little") for f in device.wire.record.since(mark, 0x180 + device.node)]

        # Frames are recorded by a thread of their own, which may be later than the answer by SDO.
        until(lambda: 0x07 in [word & 0x6F for word in words()], 1.0)
        return words()

    # The plant goes on by the wall clock: on a busy machine the joint may have come to rest at its end before
    # the stop is said, which then is none. Back it moves again, by more torque.
    for torque in [value, -3 * value, 3 * value, -3 * value]:
        words = words_of_a_stop(torque)
        if 0x07 in [word & 0x6F for word in words]:
            break
    assert 0x07 in [word & 0x6F for word in words], [f"{word:#06x}" for word in words]
    if profile == "epos2":
        assert EPOS2_WORDS[QUICK_STOP] in [word & 0x417F for word in words]


@pytest.mark.parametrize("profile", DRIVES)
def test_remote_bit_says_operational(device, power, profile):
    assert device.sdo[0x6041].raw & 0x200 == 0
    device.nmt(0x01)
    assert until(lambda: device.sdo[0x6041].raw & 0x200)
    device.nmt(0x80)
    assert until(lambda: device.sdo[0x6041].raw & 0x200 == 0)
