"""Each EDS as other tools read it: Lely's dcfgen and dcfchk, a plain INI parser; and what is beside it."""

import configparser
import pathlib
import re
import subprocess
import sys

import pytest
import yaml

import objects
from conftest import PROFILES

NODE = 5
NUMBER = re.compile(r"(\$NODEID\+)?-?(0x[0-9A-Fa-f]+|\d+)")
TEXT_TYPES = {0x9, 0xA, 0xF}
# What dcfgen is asked to map into TPDO1 and RPDO1, and one entry that it must then write.
MAPS = {
    "gold": ([0x6064, 0x6077, 0x6041], [0x6071, 0x607A, 0x6060], ["20 00 64 60", "10 00 71 60"]),
    "epos2": ([0x6064, 0x6078, 0x6041], [0x2030, 0x2062, 0x6060], ["10 00 78 60", "10 00 30 20"]),
    "encoder_card": ([0x2100], [], ["40 00 00 21"]),
}


def tool(name, *arguments, folder):
    """A program of dcf-tools. @return what it said, errors and warnings included."""
    program = pathlib.Path(sys.executable).parent / name
    done = subprocess.run(
        [program, *map(str, arguments)], cwd=folder, capture_output=True, text=True, check=False
    )
    return done.returncode, done.stdout, done.stderr


def run_dcfgen(eds, profile, folder):
    """Lely's configuration of a master with this one slave."""

    def pdo(mapped):
        entries = [{"index": index, "sub_index": 0} for index in mapped]
        return {1: {"enabled": True, "transmission": 1, "mapping": entries}} if mapped else {}

    sent, received, _ = MAPS[profile]
    slave = {"dcf": str(eds), "node_id": NODE, "tpdo": pdo(sent), "rpdo": pdo(received)}
    (folder / "bus.yml").write_text(yaml.safe_dump({"master": {"node_id": 100}, "slave": slave}))
    return tool("dcfgen", "-r", "-v", "-d", ".", "bus.yml", folder=folder)


def plain_ini(path):
    """As strict and as simple as python's own parser is by default: no comments behind values."""
    text = configparser.RawConfigParser()
    text.optionxform = str
    with open(path, encoding="utf-8") as file:
        text.read_file(file)
    return text


@pytest.mark.parametrize("profile", PROFILES)
def test_lely_makes_a_master_of_it_without_a_warning(profile, tmp_path):
    status, said, complaints = run_dcfgen(objects.eds_path(profile), profile, tmp_path)
    assert (status, complaints) == (0, "")
    assert (tmp_path / "master.dcf").exists()
    assert all(entry in said for entry in MAPS[profile][2]), said
    assert tool("dcfchk", "-n", NODE, objects.eds_path(profile), folder=tmp_path) == (0, "", "")


@pytest.mark.parametrize("profile", PROFILES)
def test_lely_refuses_it_with_a_key_of_ours(profile, tmp_path):
    """So that the test above can fail."""
    text = objects.eds_path(profile).read_text(encoding="utf-8")
    (tmp_path / "ours.eds").write_text(text + "Unit=ms\n", encoding="utf-8")
    status, _, complaints = run_dcfgen(tmp_path / "ours.eds", profile, tmp_path)
    assert status != 0 and "Unit" in complaints


@pytest.mark.parametrize("profile", PROFILES)
def test_a_plain_ini_parser_reads_every_value(profile):
    eds = plain_ini(objects.eds_path(profile))
    wanted = objects.from_eds(profile, NODE)
    values = 0
    for name in eds.sections():
        section = eds[name]
        assert all(";" not in value for value in section.values()), name
        if "DataType" not in section:
            continue
        values += 1
        number = int(section["DataType"], 0) not in TEXT_TYPES
        for key in ("DefaultValue", "LowLimit", "HighLimit") if number else ():
            assert NUMBER.fullmatch(section.get(key) or "0"), f"[{name}] {key}={section[key]}"
        assert set(section) <= objects.EDS_KEYS, name
    assert values == len(wanted)


@pytest.mark.parametrize("profile", PROFILES)
def test_what_is_beside_it_names_its_objects(profile):
    extra, eds = plain_ini(objects.extra_path(profile)), plain_ini(objects.eds_path(profile))
    assert extra.sections(), "nothing there"
    for name in extra.sections():
        assert "DataType" in eds[name], f"[{name}] is no object"
        assert set(extra[name]) <= {"Unit", "SprungMap"} and all(extra[name].values()), name
