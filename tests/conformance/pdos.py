"""PDOs of a device through python-canopen."""

import canopen

INVALID = 1 << 31


def abort_code(write):
    try:
        write()
    except canopen.SdoAbortedError as error:
        return error.code
    return 0


def configure(pdo, entries, kind, number, node, transmit, **more):
    pdo.cob_id = (0x180 if transmit else 0x200) + number * 0x100 + node
    pdo.enabled, pdo.rtr_allowed, pdo.trans_type = True, not transmit, kind
    pdo.inhibit_time, pdo.event_timer = more.get("inhibit"), more.get("event")
    pdo.clear()
    for index in entries:
        pdo.add_variable(index)
    pdo.save()


def silence(device):
    """Only what a test configures may send."""
    for pdo in [*device.remote.tpdo.values(), *device.remote.rpdo.values()]:
        record = pdo.com_record
        record[1].raw = record[1].raw | INVALID


def ask_by_sync(device, cob_id):
    mark = device.wire.record.mark()
    device.wire.sync()
    found = device.wire.record.wait_for_id(cob_id, mark)
    return None if found is None else bytes(found.data)
