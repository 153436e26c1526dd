"""SDO (facts canopen 1.4): segmented transfers both ways, and how they go wrong. Frames are typed by hand."""

import canopen
import pytest

import objects
from conftest import PROFILES
from wire import TIMEOUT_S

DRIVES = ["gold", "epos2"]
WIDE = {"gold": 0x2012, "epos2": 0x20C1}  # write-only u64: more than one frame can carry
NAME = "08 10 00"  # index and sub-index of the device's name
TOGGLE, TIME_OUT, COMMAND, LENGTH_LONG = "00 00 03 05", "00 00 04 05", "01 00 04 05", "12 00 07 06"
CHECKSUM = "04 00 04 05"


def ask(device, text):
    """Sends one SDO frame. @return the answer as text, without trailing spaces."""
    data = bytes.fromhex(text).ljust(8, b"\0")
    answer = device.wire.ask(0x600 + device.node, data, 0x580 + device.node)
    return "no answer" if answer is None else answer.hex(" ")


def frame(text):
    return bytes.fromhex(text).ljust(8, b"\0").hex(" ")


def id_text(index, sub=0):
    return (index.to_bytes(2, "little") + bytes([sub])).hex(" ")


@pytest.mark.parametrize("profile", PROFILES)
def test_name_longer_than_a_frame_comes_in_segments(device, profile):
    name = device.sdo[0x1008].raw
    assert name == objects.from_eds(profile, device.node)[0x1008, 0].default
    assert len(name) > 7
    data = name.encode()
    assert ask(device, f"40 {NAME}") == frame(f"41 {NAME} {len(data):02x}")
    toggle = 0
    while len(data) > 7:
        assert ask(device, f"{0x60 | toggle:02x}") == frame(f"{toggle:02x} {data[:7].hex()}")
        data, toggle = data[7:], toggle ^ 0x10
    last = toggle | (7 - len(data)) << 1 | 1
    assert ask(device, f"{0x60 | toggle:02x}") == frame(f"{last:02x} {data.hex()}")


@pytest.mark.parametrize("profile", DRIVES)
def test_eight_bytes_are_written_in_segments(device, profile):
    wide = id_text(WIDE[profile])
    assert ask(device, f"21 {wide} 08") == frame(f"60 {wide}")
    assert ask(device, "00 11 22 33 44 55 66 77") == frame("20")
    assert ask(device, "1d 88") == frame("30")
    device.sdo.download(WIDE[profile], 0, bytes(8))  # and as python-canopen does it


@pytest.mark.parametrize("profile", DRIVES)
def test_small_object_may_be_written_in_segments_and_without_a_length(device, profile):
    assert ask(device, "21 17 10 00 02") == frame("60 17 10 00")
    assert ask(device, "0b c8 00") == frame("20")
    assert device.sdo[0x1017].raw == 200
    assert ask(device, "22 17 10 00 2c 01") == frame("60 17 10 00")
    assert device.sdo[0x1017].raw == 300
    device.sdo[0x1017].raw = 0


@pytest.mark.parametrize("profile", DRIVES)
def test_wrong_toggle_ends_an_upload(device, profile):
    assert ask(device, f"40 {NAME}").startswith("41")
    assert ask(device, "70") == frame(f"80 {NAME} {TOGGLE}")
    assert ask(device, "60")[:2] == "80"
    assert len(device.sdo[0x1008].raw) > 7


@pytest.mark.parametrize("profile", DRIVES)
def test_repeated_toggle_ends_a_download(device, profile):
    wide = id_text(WIDE[profile])
    assert ask(device, f"21 {wide} 08") == frame(f"60 {wide}")
    assert ask(device, "00 11 22 33 44 55 66 77") == frame("20")
    assert ask(device, "00 11 22 33 44 55 66 77") == frame(f"80 {wide} {TOGGLE}")


@pytest.mark.parametrize("profile", DRIVES)
def test_abort_by_the_client_is_silent_and_ends_the_transfer(device, profile):
    assert ask(device, f"40 {NAME}").startswith("41")
    mark = device.wire.record.mark()
    device.wire.send(0x600 + device.node, bytes.fromhex(frame(f"80 {NAME} 00 00 00 08")))
    answer = ask(device, "60")
    assert answer[:2] == "80" and answer[-11:] == COMMAND
    assert len(device.wire.record.since(mark, 0x580 + device.node)) == 1


@pytest.mark.parametrize("profile", DRIVES)
def test_transfer_that_is_not_continued_times_out(device, profile):
    mark = device.wire.record.mark()
    assert ask(device, f"40 {NAME}").startswith("41")
    late = device.wire.record.wait_for(
        lambda f: f.arbitration_id == 0x580 + device.node and f.data[0] == 0x80, mark, 2 * TIMEOUT_S
    )
    assert late is not None and bytes(late.data).hex(" ") == frame(f"80 {NAME} {TIME_OUT}")


@pytest.mark.parametrize("profile", DRIVES)
def test_new_request_ends_the_old_transfer(device, profile):
    assert ask(device, f"40 {NAME}").startswith("41")
    assert ask(device, "40 00 10 00")[:11] == "43 00 10 00"
    assert ask(device, "60")[:2] == "80"


@pytest.mark.parametrize("profile", DRIVES)
def test_more_bytes_than_announced_are_refused(device, profile):
    wide = id_text(WIDE[profile])
    assert ask(device, f"21 {wide} 08") == frame(f"60 {wide}")
    assert ask(device, "00 11 22 33 44 55 66 77") == frame("20")
    assert ask(device, "11 88 99 aa bb cc dd ee")[:2] == "80"


@pytest.mark.parametrize("profile", DRIVES)
def test_more_bytes_than_the_object_has_are_refused_at_the_latest_with_the_last(device, profile):
    wide = id_text(WIDE[profile])
    answers = [ask(device, f"21 {wide} 09")]
    for segment in ("00 11 22 33 44 55 66 77", "1b 88 99"):
        if answers[-1][:2] != "80":
            answers.append(ask(device, segment))
    assert answers[-1] == frame(f"80 {wide} {LENGTH_LONG}")


@pytest.mark.parametrize("profile", PROFILES)
def test_unknown_commands_are_refused(device, profile):
    assert ask(device, "e0 17 10 00")[-11:] == COMMAND
    assert ask(device, "a3")[-11:] == COMMAND  # a block's start that nothing came before


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("with_crc", [True, False])
def test_name_is_read_by_block_transfer(device, profile, with_crc):
    expected = objects.from_eds(profile, device.node)[0x1008, 0].default
    with device.sdo.open(
        0x1008, 0, "rb", buffering=0, block_transfer=True, request_crc_support=with_crc
    ) as stream:
        assert stream.readall().decode() == expected
    assert device.sdo[0x1008].raw == expected  # the transfer has ended: the next one begins


@pytest.mark.parametrize("profile", DRIVES)
@pytest.mark.parametrize("with_crc", [True, False])
def test_eight_bytes_are_written_by_block_transfer(device, profile, with_crc):
    with device.sdo.open(
        WIDE[profile], 0, "wb", size=8, buffering=7, block_transfer=True, request_crc_support=with_crc
    ) as stream:
        stream.write(bytes(8))
    assert len(device.sdo[0x1008].raw) > 7


@pytest.mark.parametrize("profile", DRIVES)
def test_wrong_checksum_of_a_block_is_refused(device, profile):
    wide = id_text(WIDE[profile])
    assert ask(device, f"c6 {wide} 08") == frame(f"a4 {wide} 7f")
    device.wire.send(0x600 + device.node, bytes.fromhex("01 11 22 33 44 55 66 77"))
    assert ask(device, "82 88") == frame("a2 02 7f")
    assert ask(device, "d9 12 34") == frame(f"80 {wide} {CHECKSUM}")


@pytest.mark.parametrize("profile", DRIVES)
def test_lost_segment_of_a_block_is_asked_for_again(device, profile):
    wide = id_text(WIDE[profile])
    assert ask(device, f"c2 {wide} 08") == frame(f"a0 {wide} 7f")
    assert ask(device, "82 88") == frame("a2 00 7f")
    device.wire.send(0x600 + device.node, bytes.fromhex("01 11 22 33 44 55 66 77"))
    assert ask(device, "82 88") == frame("a2 02 7f")
    assert ask(device, "d9") == frame("a1")
