"""`sprung log mcap` read by Foxglove's own reader and Google's protocol buffers: every message, by index, with the values that stand in
the LCM log's bytes."""

import pathlib
import struct
import subprocess
import zlib

import lcm_types
import programs
import pytest
import zstandard
from google.protobuf.descriptor_pb2 import FileDescriptorSet
from mcap.reader import NonSeekingReader, SeekingReader
from mcap.stream_reader import CRCValidationError
from mcap_protobuf.decoder import DecoderFactory

_SYNC = 0xEDA1DA01
_FILES = ["packed.mcap", "plain.mcap"]


def lcm_events(path):
    """(received_us, channel, data) of each event; the format is LCM's event log."""
    log = path.read_bytes()
    at = 0
    while at < len(log):
        sync, _, received_us, channel_bytes, data_bytes = struct.unpack_from(">IqqII", log, at)
        assert sync == _SYNC
        begin = at + 28 + channel_bytes
        yield received_us, log[at + 28 : begin].decode(), log[begin : begin + data_bytes]
        at = begin + data_bytes


def comparable(value):
    """Real numbers by their bits, since NaN equals nothing."""
    return struct.pack(">d", value) if isinstance(value, float) else value


def same(value, message):
    """Whether a protobuf message has every value of an LCM message: {} or the members' paths that differ."""
    wrong = {}
    for name, expected in value.items():
        found = getattr(message, name)
        listed, several = isinstance(expected, list), hasattr(found, "__len__") and not isinstance(found, (str, bytes))
        assert listed == several, name
        pairs = list(zip(expected, found)) if listed else [(expected, found)]
        if listed and len(expected) != len(found):
            wrong[name] = (expected, found)
        for one, other in pairs:
            if isinstance(one, dict):
                wrong.update(same(one, other))
            elif isinstance(one, bytes) and isinstance(other, str):  # text in bytes of a fixed number
                if one.split(b"\0")[0].decode() != other:
                    wrong[name] = (one, other)
            elif comparable(one) != comparable(other):
                wrong[name] = (one, other)
    return wrong


@pytest.fixture(scope="module")
def recording(request, tmp_path_factory):
    """A log of a leg that gets up, and more; its first seconds as LCM log and as MCAP; all of it as MCAP."""
    sprung = pathlib.Path(request.config.getoption("--programs")) / "sprung"
    folder = tmp_path_factory.mktemp("mcap")

    def run(*arguments):
        subprocess.run([sprung, *arguments], cwd=folder, check=True, timeout=120, stdout=subprocess.DEVNULL)

    run("experiment", "--logs", ".", "step_response", "--robot", "single_leg")
    # Its runs share the cores, and whichever begins first has the first number. The longest one jumps later than is looked at here; the
    # others press on the floor from their first second.
    log = min(folder.glob("single_leg-*.lcm"), key=lambda path: path.stat().st_size)
    run("log", "cut", log, "--to", "2", "-o", "part.lcm")
    run("log", "mcap", "part.lcm", "-o", "packed.mcap")
    run("log", "mcap", "part.lcm", "--plain", "-o", "plain.mcap")
    run("log", "mcap", log, "-o", "long.mcap")
    return folder


@pytest.fixture(scope="module")
def types():
    return lcm_types.read_types(programs.TOP / "lcmtypes")


@pytest.mark.parametrize("name", _FILES)
@pytest.mark.parametrize("reader", [SeekingReader, NonSeekingReader])
def test_every_message_has_every_value_of_the_log(recording, types, name, reader):
    by_channel = {}
    for received_us, channel, data in lcm_events(recording / "part.lcm"):
        by_channel.setdefault(channel, []).append((received_us, data))
    found = 0
    published = {}  # newest by topic
    with open(recording / name, "rb") as file:
        opened = reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for schema, channel, message, decoded in opened.iter_decoded_messages(log_time_order=False):
            assert (schema.encoding, channel.message_encoding) == ("protobuf", "protobuf")
            package, kind = schema.name.split(".")
            if package in ("foxglove", "sprung"):
                continue  # beside the log's own channels: below
            assert package == "sprung_msgs"
            received_us, data = by_channel[channel.topic][message.sequence]
            published[channel.topic] = max(published.get(channel.topic, 0), received_us * 1000)
            assert message.publish_time == published[channel.topic]
            assert same(lcm_types.Decoder(types, data).decode(kind), decoded) == {}
            found += 1
    assert found == sum(map(len, by_channel.values())) > 10_000
    assert {"JOINT_STATE", "MOTION_STATE", "OPERATOR_COMMAND", "LOG_METADATA"} <= set(by_channel)


def read_all(file, reader):
    for _ in reader(file, validate_crcs=True).iter_messages(log_time_order=False):
        pass


def with_damage_at(path, offset, folder):
    damaged = bytearray(path.read_bytes())
    damaged[offset] ^= 0x01
    (folder / path.name).write_bytes(damaged)
    return open(folder / path.name, "rb")


@pytest.mark.parametrize("name", _FILES)
@pytest.mark.parametrize("reader", [SeekingReader, NonSeekingReader])
def test_damage_in_the_messages_is_noticed(recording, tmp_path, name, reader):
    with open(recording / name, "rb") as file:
        chunk = SeekingReader(file).get_summary().chunk_indexes[1]
    end = chunk.chunk_start_offset + chunk.chunk_length
    with with_damage_at(recording / name, end - 10, tmp_path) as file:
        with pytest.raises((CRCValidationError, zstandard.ZstdError)):  # zstd may be the first to stumble
            read_all(file, reader)


def test_damage_between_the_messages_is_noticed_by_who_reads_all(recording, tmp_path):
    with open(recording / "packed.mcap", "rb") as file:
        metadata = SeekingReader(file).get_summary().metadata_indexes[0]
    with with_damage_at(recording / "packed.mcap", metadata.offset + metadata.length - 5, tmp_path) as file:
        with pytest.raises(CRCValidationError, match="DataEnd"):
            read_all(file, NonSeekingReader)


@pytest.mark.parametrize("name", _FILES)
def test_attachment_and_summary_have_the_checksums_of_the_format(recording, name):
    """Which the reader does not look at; by the words of mcap.dev/spec."""
    written = (recording / name).read_bytes()
    with open(recording / name, "rb") as file:
        attachments = SeekingReader(file).get_summary().attachment_indexes
    assert {attachment.name for attachment in attachments} == {"robot.yaml", "model.xml"}
    for attachment in attachments:
        record = written[attachment.offset : attachment.offset + attachment.length]
        assert zlib.crc32(record[9:-4]) == int.from_bytes(record[-4:], "little")
    end = len(written) - 8  # magic bytes; in front of them the footer: 9, 8 and 8 bytes, checksum
    summary_start = int.from_bytes(written[end - 20 : end - 12], "little")
    assert zlib.crc32(written[summary_start : end - 4]) == int.from_bytes(written[end - 4 : end], "little")


def test_the_index_finds_a_stretch_of_time(recording):
    with open(recording / "long.mcap", "rb") as file:
        reader = SeekingReader(file)
        summary = reader.get_summary()
        statistics = summary.statistics
        assert statistics.chunk_count == len(summary.chunk_indexes) > 1
        middle = (statistics.message_start_time + statistics.message_end_time) // 2
        found = [message.log_time for _, _, message in reader.iter_messages(starting_at=middle, ending_before=middle + 10**8)]
    assert found and all(middle <= time < middle + 10**8 for time in found)


def test_protobuf_schemas_have_units_and_comments(recording):
    with open(recording / "packed.mcap", "rb") as file:
        schemas = SeekingReader(file).get_summary().schemas
    (schema,) = [schema for schema in schemas.values() if schema.name == "sprung_msgs.joint_state_t"]
    comments = {}
    for described in FileDescriptorSet.FromString(schema.data).file:
        for place in described.source_code_info.location:
            assert list(place.path[:3]) == [4, 0, 2]
            comments[described.message_type[0].field[place.path[3]].name] = place.trailing_comments
    assert comments["gear_output_torque_Nm"].startswith(" Nm; what the link feels")
    assert comments["estimated_velocity_rad_s"] == " rad/s\n"


def turned(rotation, vector):
    """A vector by a quaternion: v + 2 w (u x v) + 2 u x (u x v)."""

    def cross(a, b):
        return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])

    axis = (rotation.x, rotation.y, rotation.z)
    once = cross(axis, vector)
    twice = cross(axis, once)
    return tuple(v + 2 * rotation.w * a + 2 * b for v, a, b in zip(vector, once, twice))


def in_world(transforms, frame, point):
    while frame != "world":
        step = transforms[frame]
        moved = turned(step.rotation, point)
        point = (moved[0] + step.translation.x, moved[1] + step.translation.y, moved[2] + step.translation.z)
        frame = step.parent_frame_id
    return point


def messages_of(path, topic):
    with open(path, "rb") as file:
        for _, _, message, decoded in SeekingReader(file, decoder_factories=[DecoderFactory()]).iter_decoded_messages(topics=[topic]):
            yield message.log_time, decoded


def test_transforms_put_the_foot_where_the_simulation_had_it(recording):
    """Of each body in its parent, as 3-D panels chain them; the estimated joint angles are some 0.1 mrad off."""
    truth = {time: message.legs[0].true_foot_in_world_m for time, message in messages_of(recording / "packed.mcap", "SIM_TRUTH")}
    compared = 0
    for time, message in messages_of(recording / "packed.mcap", "/tf"):
        transforms = {one.child_frame_id: one for one in message.transforms}
        assert set(transforms) == {"base", "thigh", "shank"}
        foot = in_world(transforms, "shank", (0.422, 0.0, 0.0))
        if time in truth:
            assert foot == pytest.approx(tuple(truth[time]), abs=1e-3)
            compared += 1
    assert compared > 100


def test_shapes_come_once_and_hang_on_their_bodies(recording):
    ((_, message),) = messages_of(recording / "packed.mcap", "/robot")
    shapes = {one.id: one for one in message.entities}
    assert set(shapes) == {"world", "base", "thigh", "shank"}
    assert all(one.frame_locked and one.frame_id == name for name, one in shapes.items())
    (foot,) = [one for one in shapes["shank"].spheres if one.pose.position.x == 0.422 and one.size.x == 0.04]
    assert foot.color.a == 1.0
    assert len(shapes["base"].cubes) == 2


def test_forces_are_arrows_from_the_feet(recording):
    """The simulation's truth: 1.2 mm a newton, along the force."""
    truth = {time: message.legs[0].true_contact_force_N for time, message in messages_of(recording / "packed.mcap", "SIM_TRUTH")}
    compared = 0
    for time, message in messages_of(recording / "packed.mcap", "/forces"):
        (leg,) = message.entities
        assert (leg.id, leg.frame_id) == ("force leg", "world")
        if time not in truth or not any(truth[time]):
            continue
        arrow = leg.arrows[0]
        way = turned(arrow.pose.orientation, (arrow.shaft_length + arrow.head_length, 0.0, 0.0))
        assert way == pytest.approx(tuple(0.0012 * newton for newton in truth[time]), abs=1e-6)
        compared += 1
    assert compared > 50


def test_wrenches_are_the_forces_that_the_ground_is_estimated_to_give(recording):
    """In world, at the foot; the leg's trunk does not turn, so that trunk axes are the world's."""
    legs = {time: message.legs[0] for time, message in messages_of(recording / "packed.mcap", "JOINT_STATE")}
    pushed = 0
    for time, message in messages_of(recording / "packed.mcap", "/wrenches"):
        (one,) = message.wrenches
        assert (one.leg, one.frame_id) == ("leg", "world")
        assert (one.torque_Nm.x, one.torque_Nm.y, one.torque_Nm.z) == (0.0, 0.0, 0.0)
        force = (one.force_N.x, one.force_N.y, one.force_N.z)
        if time in legs:
            assert force == pytest.approx(tuple(legs[time].foot_force_N) if legs[time].contact else (0, 0, 0), rel=1e-6)
            pushed += legs[time].contact
    assert pushed > 20


def test_what_the_robot_does_not_have_has_no_messages(recording):
    assert list(messages_of(recording / "packed.mcap", "/imu")) == []


def test_joint_states_are_those_of_the_log(recording):
    angles = {time: message.joints[1].estimated_position_rad for time, message in messages_of(recording / "packed.mcap", "JOINT_STATE")}
    found = list(messages_of(recording / "packed.mcap", "/joint_states"))
    assert len(found) > 150
    for time, message in found:
        assert [one.name for one in message.joints] == ["hip", "knee"]
        assert message.joints[1].position == pytest.approx(angles[time], rel=1e-6)
