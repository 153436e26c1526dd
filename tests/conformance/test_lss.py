"""Layer setting services (CiA 305): python-canopen's LSS master against the simulated devices."""

import time

import canopen
import pytest

from conftest import Device
from wire import TIMEOUT_S, until

LSS = canopen.lss.LssMaster
WAITING, CONFIGURATION = LSS.WAITING_STATE, LSS.CONFIGURATION_STATE


@pytest.fixture
def profile():
    return "epos2"


@pytest.fixture
def lss(own_device):
    """python-canopen's master; every device of the bus waits."""
    master = own_device.wire.network.lss
    master.RESPONSE_TIMEOUT = TIMEOUT_S
    master.send_switch_state_global(WAITING)
    return master


def identity(device):
    return [int(device.sdo[0x1018][sub].raw) for sub in (1, 2, 3, 4)]


def boots_as(device, node, mark):
    return device.wire.record.wait_for(
        lambda f: f.arbitration_id == 0x700 + node and bytes(f.data) == b"\0", mark
    )


def forget_node(lss, device):
    """The first device alone: its node id is taken from it."""
    assert lss.send_switch_state_selective(*identity(device))
    lss.configure_node_id(0xFF)
    lss.send_switch_state_global(WAITING)
    device.nmt(0x82)


def test_identity_and_node_are_told_and_wrong_values_refused(lss, own_device):
    numbers = identity(own_device)
    assert lss.send_switch_state_selective(*numbers)
    asked = [lss.inquire_lss_address(command) for command in (0x5A, 0x5B, 0x5C, 0x5D)]
    assert asked == numbers
    assert lss.inquire_node_id() == own_device.node
    for node in (0, 128, 254):
        with pytest.raises(canopen.lss.LssError):
            lss.configure_node_id(node)
    with pytest.raises(canopen.lss.LssError):
        lss.configure_bit_timing(5)
    lss.configure_bit_timing(2)


def test_new_node_counts_from_reset_communication_with_all_its_identifiers(lss, own_device):
    new = 88
    numbers = identity(own_device)
    assert lss.send_switch_state_selective(*numbers)
    lss.configure_node_id(new)
    lss.store_configuration()
    lss.send_switch_state_global(WAITING)
    mark = own_device.wire.record.mark()
    own_device.nmt(0x82)
    assert boots_as(own_device, new, mark) is not None
    moved = Device("epos2", own_device.wire, new, None, None)
    assert identity(moved) == numbers
    assert moved.sdo[0x1800][1].raw & 0x7FF == 0x180 + new
    assert moved.sdo[0x1014].raw & 0x7FF == 0x080 + new
    mark = own_device.wire.record.mark()
    moved.nmt(0x81)  # as stored
    assert boots_as(moved, new, mark) is not None


def test_fastscan_finds_a_device_without_node_id_and_gives_it_one(lss, own_device):
    numbers = identity(own_device)
    forget_node(lss, own_device)
    mark = own_device.wire.record.mark()
    own_device.wire.send(0x600 + own_device.node, [0x40, 0, 0x10, 0, 0, 0, 0, 0])
    lss.RESPONSE_TIMEOUT = 0.05
    found, scanned = lss.fast_scan()
    assert found and list(scanned) == numbers
    lss.RESPONSE_TIMEOUT = TIMEOUT_S
    lss.configure_node_id(90)
    lss.send_switch_state_global(WAITING)
    assert boots_as(own_device, 90, mark) is not None
    assert not own_device.wire.record.since(mark, 0x580 + own_device.node)


def test_wrong_identity_is_selected_by_nobody(lss, own_device):
    vendor, product, revision, serial = identity(own_device)
    lss.RESPONSE_TIMEOUT = 0.3
    with pytest.raises(canopen.lss.LssError):
        lss.send_switch_state_selective(vendor, product, revision, serial ^ 1)
