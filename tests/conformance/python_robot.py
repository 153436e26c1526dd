"""A robot whose nodes are python-canopen's, with `sprung up` in front of them."""

import json
import os
import subprocess

import yaml

import objects
import programs
from robot_file import robot_file
from slave import POSITION, Card, Drive
from wire import Wire, until

START_RAD = 1.1  # of every joint but an abduction: inside the limits
UP_S = 12.0  # time-out for what `sprung` starts
VALUES = {
    "gold": {(0x1018, 3): 0x000103F6, (0x1018, 4): 1, (0x6079, 0): 48000, (0x6077, 0): 0},
    "epos2": {(0x1018, 3): 0x21260000, (0x1018, 4): 1, (0x6078, 0): 0},
    "encoder_card": {(0x1018, 4): 1},
}

# python answers in about a millisecond, and a shared machine stalls: 400 Hz (the estimator wants 270 at
# least), and watchdogs to match.
CYCLE_RATE = "400 Hz"
WATCHDOGS = {
    "command_hold": "300 ms",
    "command_stop": "900 ms",
    "leg_command": "300 ms",
    "joint_state": "300 ms",
    "silent_cycles": 120,
    "overruns_in_row": 60,
    "heartbeat": "50 ms",
    "heartbeat_consumer": "2000 ms",
    "drive_heartbeat": "600 ms",
}


def on_one_bus(robot):
    """The part of a robot that hangs on its first bus."""
    bus = robot["buses"][0]["name"]
    here = [a for a in robot["actuators"] if a["bus"] == bus]
    names = {a["name"] for a in here}
    legs = [leg for leg in robot["legs"] if set(leg["actuators"]) <= names]
    joints = {joint for leg in legs for joint in leg["joints"]}
    cards = [card for card in robot.get("encoder_cards", []) if card["bus"] == bus]
    whole = {"body", "gaits"}  # a part of a robot does not walk
    return {
        **{key: value for key, value in robot.items() if key not in whole},
        "buses": robot["buses"][:1],
        "actuators": here,
        "legs": legs,
        **({"encoder_cards": cards} if cards else {}),
        "joints": [joint for joint in robot["joints"] if joint["name"] in joints],
    }


def run_sprung(folder, environment, *arguments):
    """A command in a second terminal. @return exit status, and all that it said."""
    done = subprocess.run(
        [f"{folder}/sprung", *arguments],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, **environment},
        check=False,
    )
    return done.returncode, done.stdout + done.stderr


class Robot:
    """python nodes on a bus of their own as robot.yaml has them, and `sprung up` in front of them.

    @param adapt what differs in robot.yaml; changes the settings.
    @param dictionary of a profile and node: python-canopen's; else our EDS files'.
    @param values of a profile's objects at power-on."""

    def __init__(
        self, request, folder, name="single_leg", adapt=None, dictionary=objects.dictionary, values=None
    ):
        self._folder = folder
        self._programs = request.config.option.programs
        self._environment = {"SPRUNG_RUN_DIR": str(folder), "SPRUNG_PROGRAMS": self._programs}
        self._bus = programs.random_bus()
        self.wire = Wire(self._bus)
        self.settings = on_one_bus(robot_file(name, self._programs))
        self.settings.update(cycle_rate=CYCLE_RATE, simulation_watchdogs=WATCHDOGS)
        if adapt is not None:
            adapt(self.settings)
        self._dictionary, self._values = dictionary, VALUES | (values or {})
        self.drives = {a["node"]: self._drive(a) for a in self.settings["actuators"]}
        self.cards = {c["node"]: self._node(Card, c, {}) for c in self.settings.get("encoder_cards", [])}
        self.up = None

    def _node(self, kind, settings, more):
        identity = {(0x1018, 1): settings["identity"]["vendor"], (0x1018, 2): settings["identity"]["product"]}
        return kind(
            self.wire,
            settings["node"],
            self._dictionary(settings["profile"], settings["node"]),
            {**identity, **self._values[settings["profile"]], **more},
        )

    def _drive(self, settings):
        counts_per_rad = settings["encoder_counts"] * settings["gear_ratio"] / (2 * 3.14159265)
        angle_rad = 0.0 if "abduction" in settings["name"] else START_RAD
        counts = round(settings["direction"] * angle_rad * counts_per_rad)
        return self._node(Drive, settings, {(POSITION, 0): counts})

    def _robot_folder(self):
        folder = self._folder / "robot"
        folder.mkdir()
        (folder / "robot.yaml").write_text(yaml.safe_dump(self.settings, sort_keys=False))
        return folder

    def start(self):
        for node in [*self.drives.values(), *self.cards.values()]:
            node.power_up()
        self.up = programs.Program(
            self._programs,
            [
                "sprung",
                "up",
                self._robot_folder(),
                "--sim-elsewhere",
                "--no-record",
                "--rt-policy",
                "off",
                "--lcm-url",
                programs.random_lcm_url(),
                "--can",
                f"{self.settings['buses'][0]['name']}={programs.address(self._bus)}",
            ],
            self._folder / "up.txt",
            self._environment,
        )

    def start_and_wait(self):
        self.start()
        assert until(lambda: "is up" in self.up.said() or not self.up.running(), UP_S), self.up.said()
        assert self.up.running(), self.up.said()

    def sprung(self, *arguments):
        return run_sprung(self._programs, self._environment, *arguments)[1]

    def safety(self):
        text = self.sprung("status", "--json")
        return (
            json.loads(text)["safety"]
            if text.startswith("{")
            else {"state": "none", "cause": text, "detail": ""}
        )

    def wait_for_safety(self, state, cause=None):
        """`sprung status` listens for a second: a few tries are enough."""
        for _ in range(8):
            found = self.safety()
            if found["state"] == state and (cause is None or found["cause"] == cause):
                return found
        raise AssertionError(f"safety stays {found}; sprung up said:\n{self.up.said()}")

    def close(self):
        try:
            if self.up is not None:
                self.up.stop()
        finally:
            self.wire.close()
