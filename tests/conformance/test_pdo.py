"""PDOs (facts canopen 1.5): remapping byte for byte, what is refused, and data that then flows."""

import pytest

from pdos import INVALID, abort_code, ask_by_sync, configure, silence
from wire import until

DRIVES = ["gold", "epos2"]
DEVICE_STATE, NOT_MAPPABLE, TOO_LONG_MAP = 0x08000022, 0x06040041, 0x06040042
POSITION, STATUS, MODE_DISPLAY, CURRENT = 0x6064, 0x6041, 0x6061, 0x6078
CONTROL, MODE, TARGET = 0x6040, 0x6060, 0x607A


def requests_since(device, mark):
    return [bytes(f.data).hex(" ").upper() for f in device.wire.record.since(mark, 0x600 + device.node)]


@pytest.mark.parametrize("profile", DRIVES)
def test_python_canopens_remap_is_the_sequence_of_the_facts(device, profile):
    """Section 1.5's bytes are for node 1, inhibit time 10, position, current and status word."""
    mark = device.wire.record.mark()
    configure(device.remote.tpdo[1], [POSITION, CURRENT, STATUS], 1, 0, device.node, True, inhibit=10)
    node = f"{0x80 + device.node:02X}"
    assert requests_since(device, mark)[:8] == [
        f"23 00 18 01 {node} 01 00 C0",
        "2F 00 18 02 01 00 00 00",
        "2B 00 18 03 0A 00 00 00",
        "2F 00 1A 00 00 00 00 00",
        "23 00 1A 01 20 00 64 60",
        "23 00 1A 02 10 00 78 60",
        "23 00 1A 03 10 00 41 60",
        "2F 00 1A 00 03 00 00 00",
    ]
    assert requests_since(device, mark)[8:] == [f"23 00 18 01 {node} 01 00 40"]
    answers = [bytes(f.data) for f in device.wire.record.since(mark, 0x580 + device.node)]
    assert all(answer[0] == 0x60 for answer in answers) and len(answers) == 9


@pytest.mark.parametrize("profile", DRIVES)
@pytest.mark.parametrize("number", range(4))
@pytest.mark.usefixtures("power")  # switched off: until then its status word changes by itself
def test_every_pdo_can_be_remapped(device, profile, number):
    silence(device)
    configure(device.remote.tpdo[number + 1], [STATUS, POSITION], 1, number, device.node, True)
    configure(device.remote.rpdo[number + 1], [MODE, TARGET], 255, number, device.node, False)
    for pdo in (device.remote.tpdo[number + 1], device.remote.rpdo[number + 1]):
        pdo.read()
        assert pdo.enabled and pdo.length in (48, 40)
    device.nmt(0x01)
    device.wire.send(
        0x200 + number * 0x100 + device.node,
        (0).to_bytes(1, "little") + (-77).to_bytes(4, "little", signed=True),
    )
    assert until(lambda: device.sdo[TARGET].raw == -77)
    sample = ask_by_sync(device, 0x180 + number * 0x100 + device.node)
    assert sample is not None and len(sample) == 6
    assert int.from_bytes(sample[:2], "little") & 0x6F == device.sdo[STATUS].raw & 0x6F


@pytest.mark.parametrize("profile", DRIVES)
def test_map_cannot_change_while_the_pdo_is_valid(device, profile):
    tpdo = device.remote.tpdo[1]
    assert tpdo.com_record[1].raw & INVALID == 0
    assert abort_code(lambda: setattr(tpdo.map_array[0], "raw", 0)) == DEVICE_STATE
    assert abort_code(lambda: setattr(tpdo.map_array[1], "raw", 0x60640020)) == DEVICE_STATE
    tpdo.com_record[1].raw = tpdo.com_record[1].raw | INVALID
    assert (
        abort_code(lambda: setattr(tpdo.map_array[1], "raw", 0x60640020)) == DEVICE_STATE
    )  # the count is not 0
    assert abort_code(lambda: setattr(tpdo.map_array[0], "raw", 0)) == 0
    assert abort_code(lambda: setattr(tpdo.map_array[1], "raw", 0x60640020)) == 0


@pytest.mark.parametrize("profile", DRIVES)
def test_what_cannot_be_mapped_is_refused(device, profile):
    tpdo, rpdo = device.remote.tpdo[1], device.remote.rpdo[1]
    for pdo in (tpdo, rpdo):
        pdo.com_record[1].raw = pdo.com_record[1].raw | INVALID
        pdo.map_array[0].raw = 0
    refused = [(tpdo, 0x10170010), (rpdo, 0x60410010), (tpdo, 0x60640010), (rpdo, 0x60070010)]
    for pdo, entry in refused:
        assert (
            abort_code(lambda pdo=pdo, entry=entry: setattr(pdo.map_array[1], "raw", entry)) == NOT_MAPPABLE
        ), hex(entry)
    assert abort_code(lambda: setattr(tpdo.map_array[1], "raw", 0x7ABC0010)) == 0x06020000
    for sub in (1, 2, 3):
        tpdo.map_array[sub].raw = 0x60640020
    assert abort_code(lambda: setattr(tpdo.map_array[0], "raw", 3)) == TOO_LONG_MAP
    tpdo.map_array[0].raw = 2


@pytest.mark.parametrize("profile", DRIVES)
@pytest.mark.parametrize("divider", [1, 3, 240])
def test_tpdo_of_type_n_comes_with_every_nth_sync(device, profile, divider):
    silence(device)
    configure(device.remote.tpdo[1], [POSITION], divider, 0, device.node, True)
    configure(device.remote.tpdo[2], [STATUS], 1, 1, device.node, True)  # tells that a SYNC was dealt with
    device.nmt(0x01)
    came = []
    for _ in range(divider * 2 if divider > 1 else 5):
        mark = device.wire.record.mark()
        assert ask_by_sync(device, 0x280 + device.node) is not None
        came.append(len(device.wire.record.since(mark, 0x180 + device.node)))
    expected = 2 if divider > 1 else 5
    assert sum(came) == expected
    assert [n + 1 for n, count in enumerate(came) if count][0] == divider


@pytest.mark.parametrize("profile", DRIVES)
def test_rpdo_of_type_1_waits_for_sync_and_of_type_255_does_not(device, profile):
    silence(device)
    configure(device.remote.rpdo[1], [TARGET], 1, 0, device.node, False)
    configure(device.remote.rpdo[2], [MODE], 255, 1, device.node, False)
    configure(device.remote.tpdo[2], [MODE_DISPLAY], 1, 1, device.node, True)
    device.nmt(0x01)
    before = device.sdo[TARGET].raw
    device.wire.send(0x200 + device.node, (before + 1234).to_bytes(4, "little", signed=True))
    device.wire.send(0x300 + device.node, b"\1")
    assert until(lambda: device.sdo[MODE].raw == 1)
    assert device.sdo[TARGET].raw == before
    assert ask_by_sync(device, 0x280 + device.node) is not None
    assert until(lambda: device.sdo[TARGET].raw == before + 1234)


@pytest.mark.parametrize("profile", ["epos2"])
def test_event_tpdo_comes_on_change_and_not_faster_than_its_inhibit_time(device, profile):
    """The word changes six times at once; 100 ms of inhibit time let one frame through for each 100 ms."""
    silence(device)
    configure(device.remote.rpdo[1], [CONTROL], 255, 0, device.node, False)
    configure(device.remote.tpdo[1], [STATUS], 255, 0, device.node, True, inhibit=1000)
    mark = device.wire.record.mark()
    device.nmt(0x01)
    assert (
        device.wire.record.wait_for_id(0x180 + device.node, mark) is not None
    )  # the first, on entering operational
    for word in (6, 0, 6, 0, 6, 7):
        device.wire.send(0x200 + device.node, word.to_bytes(2, "little"))
    last = device.wire.record.wait_for(
        lambda f: f.arbitration_id == 0x180 + device.node and f.data[0] & 0x6F == 0x23, mark
    )
    assert last is not None, "the last change was never told"
    frames = device.wire.record.since(mark, 0x180 + device.node)
    assert len(frames) <= 2 + (frames[-1].timestamp - frames[0].timestamp) / 0.1
    assert len(frames) < 6, "changes came one by one, as without an inhibit time"


@pytest.mark.parametrize("profile", ["gold"])
def test_event_tpdo_of_a_gold_does_not_come_on_change(device, profile):
    """What makes it due is the maker's own affair (0x2F20), which nobody should rely on."""
    silence(device)
    configure(device.remote.rpdo[1], [CONTROL], 255, 0, device.node, False)
    configure(device.remote.tpdo[1], [STATUS], 255, 0, device.node, True)
    mark = device.wire.record.mark()
    device.nmt(0x01)
    device.wire.send(0x200 + device.node, (6).to_bytes(2, "little"))
    assert until(lambda: device.sdo[0x6041].raw & 0x6F == 0x21)
    assert device.wire.record.since(mark, 0x180 + device.node) == []


@pytest.mark.parametrize("profile", ["gold"])
def test_event_timer_repeats_a_tpdo(device, profile):
    silence(device)
    configure(device.remote.tpdo[1], [MODE_DISPLAY], 255, 0, device.node, True, event=20)
    mark = device.wire.record.mark()
    device.nmt(0x01)
    assert until(lambda: len(device.wire.record.since(mark, 0x180 + device.node)) >= 4)


@pytest.mark.parametrize("profile", ["encoder_card"])
def test_encoder_card_answers_sync_with_its_64_bits(device, profile):
    device.nmt(0x01)
    device.sdo[0x1800][2].raw = 1
    samples = [ask_by_sync(device, 0x180 + device.node) for _ in range(3)]
    assert all(sample is not None and len(sample) == 8 for sample in samples)
    counters = [sample[7] >> 4 for sample in samples]
    assert counters == [(counters[0] + n) % 16 for n in range(3)]
    channels = [int.from_bytes(samples[-1], "little") >> 20 * n & 0xFFFFF for n in range(3)]
    assert channels == [device.sdo[0x2101][n + 1].raw for n in range(3)]


@pytest.mark.parametrize("profile", DRIVES)
@pytest.mark.parametrize("kind", [252, 253, 255])
@pytest.mark.usefixtures("power")  # switched off: until then its status word changes by itself
def test_pdo_that_is_asked_for_by_a_remote_frame_comes(device, profile, kind):
    silence(device)
    pdo_id = 0x180 + device.node
    configure(device.remote.tpdo[1], [STATUS], kind, 0, device.node, True)
    device.sdo[0x1800][1].raw = pdo_id  # bit 30 clear: it may be asked for
    device.nmt(0x01)
    device.wire.sync()
    mark = device.wire.record.mark()
    device.wire.send(pdo_id, remote=True)
    answer = device.wire.record.wait_for_id(pdo_id, mark)
    assert answer is not None and len(answer.data) == 2
    assert int.from_bytes(bytes(answer.data), "little") & 0x6F == device.sdo[STATUS].raw & 0x6F


@pytest.mark.parametrize("profile", DRIVES)
def test_pdo_that_forbids_remote_frames_does_not_answer_one(device, profile):
    silence(device)
    pdo_id = 0x180 + device.node
    configure(device.remote.tpdo[1], [STATUS], 253, 0, device.node, True)
    device.sdo[0x1800][1].raw = pdo_id | 1 << 30
    device.nmt(0x01)
    mark = device.wire.record.mark()
    device.wire.send(pdo_id, remote=True)
    assert device.sdo[STATUS].raw is not None  # it has had the time
    answers = [f for f in device.wire.record.since(mark, pdo_id) if not f.is_remote_frame]
    assert answers == []
