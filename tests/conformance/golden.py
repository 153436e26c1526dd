"""What the bridge must send to its nodes while it boots them, typed by hand."""

# Typed from facts canopen 1.5 and design section 5 for node 1: what is written to the PDOs, in this order.
REMAP = {
    "TPDO1: position, torque, status word; every SYNC": (
        0x1800,
        """
        23 00 18 01 81 01 00 C0 | 2F 00 18 02 01 00 00 00 | 2F 00 1A 00 00 00 00 00 | 23 00 1A 01 20 00 64 60
        23 00 1A 02 10 00 77 60 | 23 00 1A 03 10 00 41 60 | 2F 00 1A 00 03 00 00 00
        23 00 18 01 81 01 00 40""",
    ),
    "RPDO1: torque, position, mode; on arrival": (
        0x1400,
        """
        23 00 14 01 01 02 00 80 | 2F 00 14 02 FF 00 00 00 | 2F 00 16 00 00 00 00 00 | 23 00 16 01 10 00 71 60
        23 00 16 02 20 00 7A 60 | 23 00 16 03 08 00 60 60 | 2F 00 16 00 03 00 00 00
        23 00 14 01 01 02 00 00""",
    ),
    "RPDO2: control word": (
        0x1401,
        """
        23 01 14 01 01 03 00 80 | 2F 01 14 02 FF 00 00 00 | 2F 01 16 00 00 00 00 00 | 23 01 16 01 10 00 40 60
        2F 01 16 00 01 00 00 00 | 23 01 14 01 01 03 00 00""",
    ),
    "TPDO2: mode display; every third SYNC, 7.5 ms": (
        0x1801,
        """
        23 01 18 01 81 02 00 C0 | 2F 01 18 02 03 00 00 00 | 2F 01 1A 00 00 00 00 00 | 23 01 1A 01 08 00 61 60
        2F 01 1A 00 01 00 00 00 | 23 01 18 01 81 02 00 40""",
    ),
    "TPDO3: off": (0x1802, "23 02 18 01 81 03 00 C0"),
    "TPDO4: off": (0x1803, "23 03 18 01 81 04 00 C0"),
    "RPDO3: off": (0x1402, "23 02 14 01 01 04 00 80"),
    "RPDO4: off": (0x1403, "23 03 14 01 01 05 00 80"),
}
EPOS2_REMAP = {
    "TPDO1: position, current, status word; every SYNC": (
        0x1800,
        """
        23 00 18 01 81 01 00 C0 | 2F 00 18 02 01 00 00 00 | 2F 00 1A 00 00 00 00 00 | 23 00 1A 01 20 00 64 60
        23 00 1A 02 10 00 78 60 | 23 00 1A 03 10 00 41 60 | 2F 00 1A 00 03 00 00 00
        23 00 18 01 81 01 00 40""",
    ),
    "TPDO2: mode display; on change, 10 ms apart": (
        0x1801,
        """
        23 01 18 01 81 02 00 C0 | 2F 01 18 02 FF 00 00 00 | 2B 01 18 03 64 00 00 00 | 2F 01 1A 00 00 00 00 00
        23 01 1A 01 08 00 61 60 | 2F 01 1A 00 01 00 00 00
        23 01 18 01 81 02 00 40""",
    ),
    "RPDO1: current, position, mode; on arrival": (
        0x1400,
        """
        23 00 14 01 01 02 00 80 | 2F 00 14 02 FF 00 00 00 | 2F 00 16 00 00 00 00 00 | 23 00 16 01 10 00 30 20
        23 00 16 02 20 00 62 20 | 23 00 16 03 08 00 60 60 | 2F 00 16 00 03 00 00 00
        23 00 14 01 01 02 00 00""",
    ),
    "RPDO4: off": (0x1403, "23 03 14 01 01 05 00 80"),
}
CARD_REMAP = {
    "TPDO1: the sample; every SYNC": (
        0x1800,
        """
        23 00 18 01 84 01 00 C0 | 2F 00 18 02 01 00 00 00 | 2F 00 1A 00 00 00 00 00 | 23 00 1A 01 40 00 00 21
        2F 00 1A 00 01 00 00 00 | 23 00 18 01 84 01 00 40""",
    )
}
# Typed from facts canopen 2.4, canopen 2.6 and robot.yaml: power off when the master is lost; motor 244879.
EPOS2_SETTINGS = {
    (0x6007, 0): 2,
    (0x605B, 0): 0,
    (0x605C, 0): 0,
    (0x605E, 0): 0,
    (0x2210, 1): 4096,
    (0x6410, 1): 2120,
    (0x6410, 3): 12,
    (0x6410, 5): 526,
}
# Typed from facts canopen 3 and robot.yaml at 400 Hz; None: must have been written, whatever the value.
SETTINGS = {
    (0x6007, 0): 2,
    (0x6075, 0): 7000,
    (0x6076, 0): 308,
    (0x60C2, 1): 25,
    (0x60C2, 2): -4,
    (0x1006, 0): 2500,
    (0x60B2, 0): 0,
    (0x1017, 0): None,
    (0x1016, 1): None,
    (0x6072, 0): None,
    (0x2F75, 0): None,
}
