"""Emergencies and their history (facts canopen 1.3), NMT during streaming (facts canopen 1.2), store and restore (facts canopen 1.6)."""

import canopen
import pytest

from conftest import PROFILES
from pdos import abort_code, ask_by_sync, configure, silence
from power_states import FAULT, FAULT_RESET, OFF, BySdo, lose_heartbeat
from sim_control import MENDED, OVER_CURRENT, OVER_TEMPERATURE, UNDER_VOLTAGE
from wire import until

DRIVES = ["gold", "epos2"]
# Facts canopen 2.5: code, bits of 0x1001 with the generic one, and python-canopen's text for this class.
OF_THE_POWER_STAGE = [
    (OVER_CURRENT, 0x2310, 0x03, "Current"),
    (UNDER_VOLTAGE, 0x3220, 0x05, "Voltage"),
    (OVER_TEMPERATURE, 0x4210, 0x09, "Temperature"),
]
SAVE, LOAD = 0x65766173, 0x64616F6C  # "save", "load" in the order of the wire


def cause_short_pdo(device):
    silence(device)
    configure(device.remote.rpdo[1], [0x6040, 0x607A], 255, 0, device.node, False)
    device.nmt(0x01)
    mark = device.wire.record.mark()
    device.wire.send(0x200 + device.node, b"\0\0")
    emergency = device.wire.record.wait_for_id(0x80 + device.node, mark)
    assert emergency is not None, "no emergency after an RPDO of 2 bytes instead of 6"
    return bytes(emergency.data)


@pytest.mark.parametrize("profile", DRIVES)
def test_rpdo_that_is_too_short_is_an_emergency_and_not_applied(device, profile):
    device.sdo[0x6007].raw = 0
    assert cause_short_pdo(device)[:3] == bytes.fromhex("10 82 11")
    parsed = device.remote.emcy.log[-1]
    assert (parsed.code, parsed.register) == (0x8210, 0x11)


@pytest.mark.parametrize("profile", DRIVES)
def test_history_holds_the_newest_first_and_is_cleared_by_zero_only(device, profile):
    device.sdo[0x6007].raw = 0
    assert device.sdo[0x1003][0].raw == 0
    cause_short_pdo(device)
    lose_heartbeat(device, 0)
    history = device.sdo[0x1003]
    assert [history[sub].raw & 0xFFFF for sub in (0, 1, 2)] == [2, 0x8130, 0x8210]
    assert abort_code(lambda: setattr(history[0], "raw", 1)) == 0x06090030
    assert history[0].raw == 2
    history[0].raw = 0
    assert history[0].raw == 0


@pytest.mark.parametrize("profile", DRIVES)
def test_faults_of_the_power_stage_have_code_register_text_and_a_place_in_the_history(
    own_bench, own_device, profile
):
    """A cause that lasts holds the drive in fault; the reset after it ends the emergency, not the history."""
    device, power = own_device, BySdo(own_device)
    device.sdo[0x6007].raw = 0
    actuator = device.robot["actuators"].index(device.settings)
    control = own_bench.sim_control()
    own_bench.start_cycles()

    def happens(kind, done):
        control.fault(actuator, kind)
        return until(lambda: device.wire.sync() or done())

    def resets():
        power.command(0)
        power.command(FAULT_RESET)
        return power.settled() == OFF

    def told(mark, code):
        frame = device.wire.record.wait_for(
            lambda f: f.arbitration_id == 0x80 + device.node and f.data[:2] == code.to_bytes(2, "little"),
            mark,
            0.02,
        )
        return bytes(frame.data) if frame else None

    power.command(FAULT_RESET)  # an EPOS2 comes up in fault
    assert power.reaches(OFF)
    device.sdo[0x1003][0].raw = 0
    for place, (kind, code, register, text) in enumerate(OF_THE_POWER_STAGE, 1):
        power.command(0)
        mark = device.wire.record.mark()
        assert happens(kind, lambda mark=mark, code=code: told(mark, code)), f"no emergency {code:#x}"
        assert power.reaches(FAULT)
        assert told(mark, code)[2] == register == device.sdo[0x1001].raw
        newest = device.remote.emcy.log[-1]
        assert (newest.code, newest.register, newest.get_desc()) == (code, register, text)
        if kind != OVER_CURRENT:  # its cause is over at once
            power.command(FAULT_RESET)
            assert power.settled() == FAULT
            power.command(0)
        assert happens(MENDED, resets)
        assert told(mark, 0)[2] == 0 == device.sdo[0x1001].raw
        found = [device.sdo[0x1003][sub].raw & 0xFFFF for sub in range(place + 1)]
        assert found == [place, *[code for _, code, *_ in reversed(OF_THE_POWER_STAGE[:place])]]
    control.close()


@pytest.mark.parametrize("profile", DRIVES)
def test_stop_and_start_during_streaming(device, profile):
    silence(device)
    configure(device.remote.tpdo[1], [0x6064, 0x6041], 1, 0, device.node, True)
    device.sdo[0x1017].raw = 20
    device.nmt(0x01)
    assert ask_by_sync(device, 0x180 + device.node) is not None
    mark = device.wire.record.mark()
    device.nmt(0x02)
    assert device.wire.record.wait_for(
        lambda f: f.arbitration_id == 0x700 + device.node and f.data[0] == 4, mark
    )
    mark = device.wire.record.mark()
    device.wire.sync()
    device.wire.send(0x600 + device.node, bytes.fromhex("40 00 10 00 00 00 00 00"))
    device.wire.record.wait_for_id(0x700 + device.node, mark)
    device.wire.record.wait_for_id(0x700 + device.node, device.wire.record.mark())
    assert not device.wire.record.since(mark, 0x180 + device.node)
    assert not device.wire.record.since(mark, 0x580 + device.node)
    device.nmt(0x01)
    assert ask_by_sync(device, 0x180 + device.node) is not None


@pytest.mark.parametrize("profile", DRIVES)
def test_reset_of_the_node_during_streaming_forgets_what_was_set(device, profile):
    silence(device)
    configure(device.remote.tpdo[1], [0x6064, 0x6041], 1, 0, device.node, True)
    device.sdo[0x6007].raw = 0
    device.nmt(0x01)
    assert ask_by_sync(device, 0x180 + device.node) is not None
    device.reset(0x81)
    assert device.sdo[0x1800][2].raw == 255
    assert device.sdo[0x6007].raw == {"gold": 1, "epos2": 3}[profile]
    mark = device.wire.record.mark()
    device.wire.sync()
    device.sdo[0x1000].raw  # dealt with after the SYNC
    assert not device.wire.record.since(mark, 0x180 + device.node)


@pytest.mark.parametrize("profile", DRIVES)
def test_reset_communication_forgets_communication_only(device, profile):
    silence(device)
    configure(device.remote.tpdo[1], [0x6064], 1, 0, device.node, True)
    device.sdo[0x6007].raw = 0
    device.sdo[0x1017].raw = 500
    device.reset(0x82)
    assert (device.sdo[0x1800][2].raw, device.sdo[0x1A00][1].raw, device.sdo[0x1017].raw) == (
        255,
        0x60410010,
        0,
    )
    assert device.sdo[0x6007].raw == 0


@pytest.mark.parametrize("profile", PROFILES)
def test_broadcast_reaches_every_node(device, profile):
    mark = device.wire.record.mark()
    device.nmt(0x82, 0)
    nodes = (
        [device.node]
        if device.settings is None
        else [
            d["node"]
            for d in device.robot["actuators"] + device.robot.get("encoder_cards", [])
            if d["bus"] == device.settings["bus"]
        ]
    )
    for node in nodes:
        boot = device.wire.record.wait_for_id(0x700 + node, mark)
        assert boot is not None and bytes(boot.data) == b"\0", f"node {node}"
    mark = device.wire.record.mark()
    device.nmt(0x81, device.node % 127 + 20)  # nobody's
    assert device.wire.record.wait_for_id(0x700 + device.node, mark, 0.1) is None


@pytest.mark.parametrize("profile", DRIVES)
def test_stored_parameters_outlive_a_reset_until_defaults_are_restored(device, profile):
    option, pdo_type = device.sdo[0x6007], device.sdo[0x1800][2]
    default = option.raw
    try:
        option.raw, pdo_type.raw = 2, 1
        device.sdo[0x1010][1].raw = SAVE
        device.reset()
        assert (option.raw, pdo_type.raw) == (2, 1)
        device.sdo[0x1011][1].raw = LOAD
        assert (option.raw, pdo_type.raw) == (2, 1)  # takes effect with the next reset
    finally:
        device.sdo[0x1011][1].raw = LOAD
        device.reset()
    assert (option.raw, pdo_type.raw) == (default, 255)


@pytest.mark.parametrize("profile", DRIVES)
@pytest.mark.parametrize("index", [0x1010, 0x1011])
def test_store_and_restore_want_their_word(device, profile, index):
    with pytest.raises(canopen.SdoAbortedError) as error:
        device.sdo[index][1].raw = SAVE ^ LOAD
    assert error.value.code == 0x08000020
    assert until(lambda: device.sdo[0x1000].raw)
