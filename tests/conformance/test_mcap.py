"""`sprung log mcap` read by Foxglove's own reader: every message, by index, with the values that stand in the LCM log's bytes."""

import json
import pathlib
import struct
import subprocess

import pytest
from mcap.reader import NonSeekingReader, SeekingReader

_SYNC = 0xEDA1DA01
_STAMP = struct.Struct(">qqqqi")  # hash, session, utime, seq, n_actuators


def lcm_events(path):
    """(received_us, channel, data) of each event; the format is LCM's: facts/lcm.md."""
    log = path.read_bytes()
    at = 0
    while at < len(log):
        sync, _, received_us, channel_bytes, data_bytes = struct.unpack_from(">IqqII", log, at)
        assert sync == _SYNC
        begin = at + 28 + channel_bytes
        yield received_us, log[at + 28 : begin].decode(), log[begin : begin + data_bytes]
        at = begin + data_bytes


@pytest.fixture(scope="module")
def recording(request, tmp_path_factory):
    """An LCM log of a knee on its bench, and the same as MCAP, packed and plain."""
    sprung = pathlib.Path(request.config.getoption("--programs")) / "sprung"
    folder = tmp_path_factory.mktemp("mcap")

    def run(*arguments):
        subprocess.run([sprung, *arguments], cwd=folder, check=True, timeout=120, stdout=subprocess.DEVNULL)

    run("identify", "--record", "single_leg", "knee", "--in-process", "--out", "knee.lcm")
    run("log", "mcap", "knee.lcm", "-o", "packed.mcap")
    run("log", "mcap", "knee.lcm", "--plain", "-o", "plain.mcap")
    return folder


@pytest.mark.parametrize("name", ["packed.mcap", "plain.mcap"])
@pytest.mark.parametrize("reader", [SeekingReader, NonSeekingReader])
def test_every_message_has_the_values_of_the_log(recording, name, reader):
    events = [event for event in lcm_events(recording / "knee.lcm") if event[1] == "DRIVE_STATE"]
    with open(recording / name, "rb") as file:
        messages = [found for found in reader(file, validate_crcs=True).iter_messages(topics=["DRIVE_STATE"])]
    assert len(messages) == len(events) > 1000
    for (received_us, _, data), (schema, channel, message) in zip(events, messages):
        assert (schema.name, schema.encoding, channel.message_encoding) == ("drive_state_t", "jsonschema", "json")
        assert message.publish_time == received_us * 1000
        value = json.loads(message.data)
        _, session, utime, seq, actuators = _STAMP.unpack_from(data)
        assert (value["session"], value["utime"], value["seq"]) == (session, utime, seq)
        assert len(value["actuators"]) == actuators
        (position,) = struct.unpack_from(">d", data, _STAMP.size)
        found = value["actuators"][0]["measured_position_rad"]
        assert found == position or (found is None and position != position)


def test_the_index_finds_a_stretch_of_time(recording):
    with open(recording / "packed.mcap", "rb") as file:
        reader = SeekingReader(file)
        summary = reader.get_summary()
        statistics = summary.statistics
        assert statistics.chunk_count == len(summary.chunk_indexes) > 1
        middle = (statistics.message_start_time + statistics.message_end_time) // 2
        found = [message.log_time for _, _, message in reader.iter_messages(starting_at=middle, ending_before=middle + 10**8)]
    assert found and all(middle <= time < middle + 10**8 for time in found)


def test_schemas_describe_the_messages(recording):
    with open(recording / "packed.mcap", "rb") as file:
        schemas = SeekingReader(file).get_summary().schemas
    for schema in schemas.values():
        text = json.loads(schema.data)
        assert text["type"] == "object" and text["title"] == schema.name
        assert text["properties"]["seq"] == {"type": "integer", "description": text["properties"]["seq"]["description"]}
