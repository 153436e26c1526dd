"""Options and fixtures: one simulated robot a profile and run, or a real drive by --bus."""

import collections

import can
import canopen
import pytest

import objects
import programs
from power_states import OFF, BySdo
from robot_file import robot_file
from sim_control import SimControl
from wire import TIMEOUT_S, Wire, until

Profile = collections.namedtuple("Profile", "robot actuator")  # where the profile is found in robots/
PROFILES = {
    "gold": Profile("single_leg", True),
    "epos2": Profile("pegasus", True),
    "encoder_card": Profile("pegasus", False),
}

SUMMARY = []  # lines that belong at the end of a run, whatever passed


def pytest_terminal_summary(terminalreporter):
    for line in SUMMARY:
        terminalreporter.write_line(line)


def pytest_addoption(parser):
    parser.addoption(
        "--programs", default=str(programs.TOP / "build/release/bin"), help="folder of sprung's programs"
    )
    parser.addoption(
        "--bus",
        help="a real drive: socketcan:can0, or udp_multicast:GROUP:PORT; "
        "needs --read-only, --node and --profile",
    )
    parser.addoption("--node", type=int, help="its node id")
    parser.addoption("--profile", choices=sorted(PROFILES), help="which EDS it should agree with")
    parser.addoption("--read-only", action="store_true", help="read every object, write none")


def pytest_configure(config):
    config.addinivalue_line(
        "markers", "reads_only: changes nothing on the device; may be run on a real drive"
    )
    option = config.option
    if option.bus and not (option.read_only and option.node and option.profile):
        raise pytest.UsageError(
            "--bus names a real drive, which only a read-only scan may touch: "
            "add --read-only --node N --profile P"
        )


def pytest_collection_modifyitems(config, items):
    if not config.option.bus:
        return
    real = [
        item
        for item in items
        if item.get_closest_marker("reads_only")
        and item.callspec.params.get("profile", config.option.profile) == config.option.profile
    ]
    items[:] = real


class Device:
    """A simulated (or real) node on its bus, as python-canopen's master sees it."""

    def __init__(self, profile, wire, node, robot, settings):
        self.profile, self.wire, self.node = profile, wire, node
        self.robot, self.settings = robot, settings  # robot.yaml, and the device's part of it
        self.remote = canopen.BaseNode402(node, objects.dictionary(profile, node))
        self._connect()

    def _connect(self):
        self.wire.network.add_node(self.remote)
        self.sdo = self.remote.sdo

    def nmt(self, command, node=None):
        self.wire.send(0x000, [command, self.node if node is None else node])

    def reset(self, command=0x81):
        """NMT reset and the boot-up that must follow; afterwards the device is as after power-on."""
        mark = self.wire.record.mark()
        self.nmt(command)
        boot = self.wire.record.wait_for(
            lambda f: f.arbitration_id == 0x700 + self.node and bytes(f.data) == b"\0", mark
        )
        assert boot is not None, f"no boot-up frame after NMT 0x{command:02X}"

    def reset_communication_after_loss(self):
        """First half of the way back after a lost master (facts canopen 2.5). What watched the master is off then."""
        self.reset(0x82)

    def forget_python_state(self):
        """A new python-canopen node: the old one's cached PDOs are those of the last test."""
        for pdo in [*self.remote.tpdo.values(), *self.remote.rpdo.values()]:
            pdo.callbacks.clear()
        self.wire.network.pop(self.node)
        self.remote = canopen.BaseNode402(self.node, objects.dictionary(self.profile, self.node))
        self._connect()


class Bench:
    """One process of simulated drives; its buses and wires."""

    def __init__(self, folder, robot, log):
        self.robot = robot_file(robot, folder)
        buses = {bus["name"]: programs.random_bus() for bus in self.robot["buses"]}
        first = self.robot["buses"][0]["name"]
        self.first = first
        self.wire = Wire(buses[first])
        self._others = [arguments for name, arguments in buses.items() if name != first]
        self._folder = folder
        started = programs.start_simulated_drives(folder, robot, buses, log)
        self.process, self._lcm_url, self._session = started
        nodes = [
            d["node"]
            for d in self.robot["actuators"] + self.robot.get("encoder_cards", [])
            if d["bus"] == first
        ]
        awaited = {0x700 + node for node in nodes}
        until(lambda: awaited <= self._booted() or not self.process.running(), 3 * TIMEOUT_S)
        assert awaited <= self._booted(), (
            f"not every node booted; sprung-sim-drives said:\n{self.process.said()}"
        )

    def _booted(self):
        return {
            f.arbitration_id
            for f in self.wire.record.since(0)
            if f.arbitration_id & 0x700 == 0x700 and bytes(f.data) == b"\0"
        }

    def settings(self, profile):
        found = self.robot["actuators"] if PROFILES[profile].actuator else self.robot["encoder_cards"]
        return next(d for d in found if d["bus"] == self.first and d["profile"] == profile)

    def start_cycles(self):
        """Every node of every bus operational: from the next SYNC on cycles count, and the plant moves."""
        for arguments in self._others:
            with can.Bus(**arguments) as bus:
                bus.send(can.Message(arbitration_id=0, data=[0x01, 0], is_extended_id=False))
        self.wire.send(0x000, [0x01, 0])

    def sim_control(self):
        return SimControl(self._folder, self._lcm_url, self._session)

    def close(self):
        self.wire.close()
        assert self.process.stop() == 0, self.process.said()


@pytest.fixture(scope="session")
def benches(request, tmp_path_factory):
    """@return a function: the bench of a robot, started when it is first needed."""
    started = {}

    def bench(robot):
        if robot not in started:
            log = tmp_path_factory.mktemp("programs") / f"{robot}.log"
            started[robot] = Bench(request.config.option.programs, robot, log)
        return started[robot]

    yield bench
    for one in started.values():
        one.close()


@pytest.fixture(scope="session")
def devices(request, benches):
    """@return a function: the device of a profile."""
    made = {}
    option = request.config.option

    def real(profile):
        interface, channel, *port = option.bus.split(":")
        more = {"port": int(port[0])} if port else {}
        return Device(
            profile, Wire({"interface": interface, "channel": channel, **more}), option.node, None, None
        )

    def simulated(profile):
        bench = benches(PROFILES[profile].robot)
        settings = bench.settings(profile)
        return Device(profile, bench.wire, settings["node"], bench.robot, settings)

    def device(profile):
        if profile not in made:
            made[profile] = (real if option.bus else simulated)(profile)
        return made[profile]

    yield device
    if option.bus:
        for one in made.values():
            one.wire.close()


@pytest.fixture
def own_bench(request, tmp_path, profile):
    """A simulation that this test has for itself: its plant may move."""
    bench = Bench(request.config.option.programs, PROFILES[profile].robot, tmp_path / "drives.log")
    yield bench
    bench.close()


@pytest.fixture
def own_device(own_bench, profile):
    """The first device of this profile in it."""
    settings = own_bench.settings(profile)
    return Device(profile, own_bench.wire, settings["node"], own_bench.robot, settings)


@pytest.fixture
def device(devices, profile):
    """The device of the test's parameter `profile`, as after power-on."""
    one = devices(profile)
    if one.settings is not None:
        one.forget_python_state()
        one.reset()
    return one


@pytest.fixture
def power(device):
    """The power states of `device`, switched off."""
    one = BySdo(device)
    assert one.reaches(OFF), f"after power-on: {one.state()}"
    yield one
    one.command(0)
