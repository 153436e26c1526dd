"""`sprung up` in front of nodes made of the makers' figures, limits enforced; and jumps on simulated drives of
both makes, which test_makers.py holds to the same limits."""

import functools
import re
import shutil

import pytest

import makers
import programs
from golden import EPOS2_REMAP, REMAP
from power_states import ENABLED, OFF
from python_robot import UP_S, Robot, run_sprung
from slave import Drive
from test_bridge import check_remap, sent_to
from wire import until

ABORT = 0x80
BRIDGE = 127


def without_cards(settings):
    """The drives alone: their encoders count as referenced."""
    settings.pop("encoder_cards")
    for actuator in settings["actuators"]:
        actuator.pop("link_encoder")
        actuator.pop("reference")
        actuator["referenced"] = True


LEGS = {"gold": ("single_leg", None, REMAP), "epos2": ("pegasus", without_cards, EPOS2_REMAP)}


def leg_of(make, request, folder, consumer_limit=False, values=None):
    name, adapt, _ = LEGS[make]
    dictionary = functools.partial(makers.dictionary, consumer_limit=consumer_limit)
    return Robot(request, folder, name, adapt, dictionary, {make: makers.VALUES[make] | (values or {})})


def aborts_of(leg):
    """@return (index, sub-index, code) of what the drives refused."""
    frames = [f for node in leg.drives for f in leg.wire.record.since(0, 0x580 + node) if f.data[0] == ABORT]
    return {
        (f.data[1] | f.data[2] << 8, f.data[3], int.from_bytes(f.data[4:], "little")) for f in frames
    }


@pytest.mark.parametrize("make", makers.MAKES)
def test_check_of_makers_drives_asks_only_for_objects_that_they_have(make, request, tmp_path):
    leg = leg_of(make, request, tmp_path)
    try:
        status, said = leg.drive_check()
        assert status == 1, "as delivered they are not as the robot wants them"
        assert all(f"{actuator['name']}: node" in said for actuator in leg.settings["actuators"]), said
        assert re.search(r"0x6075:00 .* 7000 mA +0 mA +DIFFERS|0x6410:01 .* 2120 mA +5000 mA +DIFFERS", said), said
        assert aborts_of(leg) == set()
    finally:
        leg.close()


@pytest.mark.parametrize("make", makers.MAKES)
def test_makers_drives_boot_stand_fail_and_are_brought_back(make, request, tmp_path):
    leg = leg_of(make, request, tmp_path)
    drives = list(leg.drives.values())
    try:
        leg.start_and_wait()
        leg.wait_for_safety("operational")
        assert aborts_of(leg) == set()
        check_remap(leg, 1, LEGS[make][2])
        assert all(sent_to(leg, node) for node in leg.drives)
        assert all(drive.state == OFF for drive in drives), "nobody asked for power"

        said = leg.sprung("stand")
        assert until(lambda: all(drive.state == ENABLED for drive in drives), UP_S), said

        drives[1].fail(0x2310)
        assert until(lambda: drives[0].state == OFF, UP_S), "the healthy drive keeps its power"
        found = leg.wait_for_safety("quick stop")
        name = leg.settings["actuators"][1]["name"]
        assert found["latched"] and found["cause"] == "drive fault" and name in found["detail"], found

        said = leg.sprung("clear")
        assert not leg.wait_for_safety("operational")["latched"], said
        assert name in said and all(drive.state == OFF for drive in drives), said
        assert aborts_of(leg) == set()
    finally:
        leg.close()


@pytest.mark.parametrize(
    "make, values, words",
    [
        ("gold", {(0x6502, 0): 0x7F}, ["0x6502"]),  # no cyclic mode
        ("epos2", {(0x1018, 3): 0x21300000}, ["firmware 0x21300000"]),
    ],
    ids=["modes", "firmware"],
)
def test_drive_that_its_maker_may_sell_but_nobody_checked_is_refused(make, values, words, request, tmp_path):
    leg = leg_of(make, request, tmp_path, values=values)
    try:
        leg.start()
        found = leg.wait_for_safety("disabled", "drive refused")
        assert found["latched"] and all(word in found["detail"] for word in words), found
        assert all(drive.state == OFF for drive in leg.drives.values())
    finally:
        leg.close()


def test_gold_with_the_consumer_limit_of_its_makers_file_is_not_run_unwatched(request, tmp_path):
    """0x1016 takes no node id there, and there is no 0x100C: such a drive would not notice a lost master."""
    leg = leg_of("gold", request, tmp_path, consumer_limit=True)
    try:
        leg.start()
        found = leg.wait_for_safety("disabled", "drive refused")
        assert found["latched"] and "0x1016" in found["detail"], found
        assert leg.settings["actuators"][0]["name"] in found["detail"], found
        assert (0x1016, 1, 0x06090031) in aborts_of(leg)
        assert all(drive.state == OFF for drive in leg.drives.values())
        leg.up.stop()
        assert "boot has overwritten 0x1017:00" in leg.up.said(), "what was written before is said"
    finally:
        leg.close()


def test_drive_with_the_bridges_own_node_id_is_named_before_anything_is_commanded(request, tmp_path):
    """As a Gold may be delivered, beside a leg that is as it should be."""
    leg = leg_of("gold", request, tmp_path)
    try:
        stranger = Drive(leg.wire, BRIDGE, makers.dictionary("gold", BRIDGE), makers.VALUES["gold"])
        stranger.power_up()
        leg.start()
        assert until(lambda: "127 is the bridge's own id" in leg.up.said(), UP_S), leg.up.said()
        assert "Gold: its maker's tool" in leg.up.said()
        assert not any(sent_to(leg, node) for node in leg.drives)
        assert not leg.wire.record.since(0, 0x000), "no NMT command"
    finally:
        leg.close()


# single_leg on another make: (as it is, as that make has it) in robot.yaml and sim.yaml. 50 x the EPOS2's 10 A
# must give single_leg's 171.6 Nm, so its motors have a constant four times as high. A Gold shows a temperature.
TEMPERATURE = "temperature: {object: 0x22A2, type: u16, scale: 1 degC, max: 80 degC}"
ADAPTED = {
    "gold": [("speed_limit_object: 0x6080", f"speed_limit_object: 0x6080\n    {TEMPERATURE}")],
    "epos2": [
        ("profile: gold", "profile: epos2"),
        ("vendor: 0x9A, product: 0x00030923", "vendor: 0xFB, product: 0x63220000"),
        ("torque_constant: 0.044 Nm/A", "torque_constant: 0.176 Nm/A"),
        ("rated_current: 7.0 A", "rated_current: 1.75 A"),
        ("encoder_counts: 131072", "encoder_counts: 16384"),
        ("speed_limit_object: 0x6080", "speed_limit_object: 0x6410"),
        ("damping: 29.7 Nm s/rad}", "damping: 29.7 Nm s/rad, object: 0x60FB}"),
    ],
}


def jumper(make, folder):
    """A copy of single_leg with two drives of this make. @return its folder."""
    robot = folder / "single_leg"
    shutil.copytree(programs.TOP / "robots/single_leg", robot)
    for name in ("robot.yaml", "sim.yaml"):
        text = (robot / name).read_text()
        for old, new in ADAPTED[make]:
            assert name == "sim.yaml" or text.count(old) == 2, f"{old} in {name}"
            text = text.replace(old, new)
        (robot / name).write_text(text)
    return robot


@pytest.mark.parametrize("make", makers.MAKES)
def test_simulated_drives_stand_jump_fail_and_are_brought_back(make, request, tmp_path):
    """Under the maker's limits: test_makers.py compares theirs, object by object. What a drive refuses of its
    settings or maps ends the boot by name, so nothing was refused."""
    folder, bus = request.config.option.programs, programs.random_bus()
    environment = {"SPRUNG_RUN_DIR": str(tmp_path), "SPRUNG_PROGRAMS": folder}
    arguments = [
        *("sprung", "up", jumper(make, tmp_path), "--sim", "--clock", "lockstep", "--no-record"),
        *("--lcm-url", programs.random_lcm_url(), "--can", f"leg={programs.address(bus)}"),
    ]
    up = programs.Program(folder, arguments, tmp_path / "up.txt", environment)

    def run(*words):
        status, said = run_sprung(folder, environment, *words)
        assert status == 0, said
        return said

    try:
        assert until(lambda: "is up" in up.said() or not up.running(), UP_S), up.said()
        assert up.running(), up.said()
        run("stand")
        height_mm = re.search(r"jump 1: (\d+) mm high", run("jump"))
        assert height_mm and int(height_mm.group(1)) > 50
        assert make != "gold" or "40 degC" in run("status")
        assert "boot has overwritten" in up.said() and "refused" not in up.said(), up.said()
        run("fault", "knee", "over-current", "--for", "0.2")
        assert until(lambda: "drive fault" in run_sprung(folder, environment, "status")[1], UP_S)
        assert "done: cleared" in run("clear")
        run("stand")
    finally:
        up.stop()
