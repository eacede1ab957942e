"""What the frames of docs/fieldbus.md say, decoded by hand from python-can's messages after ISO 11783-7 and CiA 301."""
import struct

NOT_KNOWN = -32768
ACTIVE, FAULT_HOLD = 0x0F, 0x03


def grouped(messages):
    """Messages by (is extended, identifier), in their order."""
    groups = {}
    for message in messages:
        groups.setdefault((message.is_extended_id, message.arbitration_id), []).append(message)
    return groups


def median_step(messages):
    """Seconds from one to the next."""
    steps = sorted(after.timestamp - before.timestamp for before, after in zip(messages, messages[1:]))
    return steps[len(steps) // 2]


def sdo_read(index, sub):
    """The eight bytes that ask for an object."""
    return struct.pack("<BHB4x", 0x40, index, sub)


def sdo_value(message):
    """Index, sub-index and bytes of an expedited answer; the abort code as a whole number where it is a refusal."""
    command, index, sub = struct.unpack("<BHB", message.data[:4])
    if command == 0x80:
        return index, sub, struct.unpack("<I", message.data[4:])[0]
    assert command & 0xE3 == 0x43, message
    return index, sub, bytes(message.data[4:8 - (command >> 2 & 3)])


def process_data(message):
    """Status word, flow, lower and upper end of its band."""
    return struct.unpack("<Hhhh", message.data)


def agreeing_flows(flows, data):
    """How many J1939 flows say what the process data next to them say; all of both must be decodable."""
    agreeing = 0
    data = sorted(data, key=lambda one: one.timestamp)
    for message in flows:
        extend, retract, state, limit = message.data[:4]
        assert retract in (0xFF, 125) or extend in (0xFF, 125) or state == 0xFE, message
        assert limit == 0xFF and bytes(message.data[4:]) == b"\xff" * 4, message
        # the process data of the same instant have the same flow, but for what it changes within some milliseconds
        near = min(data, key=lambda one: abs(one.timestamp - message.timestamp))
        word, flow, lower, upper = process_data(near)
        if extend > 250 or flow == NOT_KNOWN or word != ACTIVE:
            continue
        assert lower <= flow <= upper, near
        agreeing += abs((extend - 125) - 100 * flow / 16384) < 2
    return agreeing
