#!/usr/bin/python3
"""judge.py reads EDS: what a master asks node 17 for, as cansend takes it. judge.py judge EDS HEARD: whether what was heard in
the emulated machine (machine.sh) is what docs/fieldbus.md promises."""
import configparser
import json
import os
import re
import sys

import can

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from can_frames import (ACTIVE, FAULT_HOLD, NOT_KNOWN, agreeing_flows, grouped, median_step, process_data,  # noqa: E402
                        sdo_read, sdo_value)

CLAIMED, LOST, FLOW, SILENT_FLOW = (True, 0x18EEFF80), (True, 0x18EEFFFE), (True, 0x0CFE1380), (True, 0x0CFE1480)
MARK = (False, 0x7E0)
OBJECTION_S = 0.24  # SAE J1939-81: 0.25 from the claim to what is sent under it
SIZES = {3: (2, True), 4: (4, True), 5: (1, False), 6: (2, False), 7: (4, False)}  # of CiA 301's data types


def objects(eds):
    """(index, sub-index) of each readable object to its entry in the electronic data sheet."""
    sheet = configparser.ConfigParser(interpolation=None)
    sheet.read(eds, encoding="utf-8")
    named = {name: re.fullmatch(r"([0-9A-F]{4})(?:sub([0-9A-F]+))?", name) for name in sheet.sections()}
    return {(int(at[1], 16), int(at[2] or "0", 16)): sheet[name]
            for name, at in named.items() if at and "DataType" in sheet[name]}


def parts(messages):
    """The story's parts, by the number that each began with."""
    out = {0: []}
    for message in messages:
        if (message.is_extended_id, message.arbitration_id) == MARK:
            out[message.data[0]] = []
        else:
            out[max(out)].append(message)
    return out


def judge_starts(text):
    assert text("absent.status") == "2" and "no CAN interface nocan9: No such device" in text("absent.said"), text("absent.said")
    assert text("down.status") == "2" and "vcan0" in text("down.said"), text("down.said")
    assert "ip link set" in text("absent.said") and "ip link set" in text("down.said")
    assert text("live.status") == "0", text("live.said")


def judge_flows(messages):
    """What is sent by itself, of a valve that is known and one that is not."""
    groups = grouped(messages)
    assert set(groups) == {CLAIMED, FLOW, SILENT_FLOW} | {(False, base + node) for base in (0x180, 0x700) for node in (17, 18, 19)}, groups.keys()
    order = [(one.is_extended_id, one.arbitration_id) for one in messages]
    assert order[0] == CLAIMED and len(groups[CLAIMED]) == 1, messages[0]
    quiet_s = min(groups[name][0].timestamp for name in (FLOW, SILENT_FLOW)) - messages[0].timestamp
    assert quiet_s > OBJECTION_S, quiet_s
    for name in (FLOW, (False, 0x191), (False, 0x192)):
        assert abs(median_step(groups[name]) - 0.1) < 0.02, (name, median_step(groups[name]))
    for node in (17, 18, 19):
        states = [one.data[0] for one in groups[(False, 0x700 + node)]]
        assert states[0] == 0 and set(states[1:]) == {5}, (node, states)
        assert abs(median_step(groups[(False, 0x700 + node)]) - 1) < 0.2
    known = [one for one in groups[(False, 0x191)] if process_data(one)[0] == ACTIVE]
    agreeing = agreeing_flows(groups[FLOW], groups[(False, 0x191)])
    assert agreeing > 0.5 * len(known) > 20, (agreeing, len(known))
    assert {process_data(one) for one in groups[(False, 0x193)]} == {(FAULT_HOLD,) + 3 * (NOT_KNOWN,)}
    assert {bytes(one.data) for one in groups[SILENT_FLOW]} == {b"\xff" * 8}
    return quiet_s, agreeing


def judge_objects(messages, eds):
    """Each object of the sheet is answered in its size, and with its default where it has one."""
    answers = [sdo_value(one) for one in messages if one.arbitration_id == 0x591]
    sheet = objects(eds)
    values = {}
    for (index, sub, value), asked in zip(answers, sheet):
        size, signed = SIZES[int(sheet[asked]["DataType"], 16)]
        assert (index, sub) == asked and not isinstance(value, int) and len(value) == size, (asked, index, sub, value)
        values[asked] = int.from_bytes(value, "little", signed=signed)
        default = sheet[asked]["DefaultValue"].replace("$NODEID+0x40000180", "0x40000191")
        assert not default or values[asked] == int(default, 16), (asked, values[asked], default)
    assert values[(0x1000, 0)] == 408 and values[(0x6041, 0)] in (ACTIVE, FAULT_HOLD), values
    assert values[(0x1001, 0)] in (0, 0x81) and 10_000 < values[(0x2000, 7)] < 200_000, values
    refusals = [value for _, _, value in answers[len(sheet):]]
    assert refusals == [0x06010002, 0x06020000, 0x06090011], refusals
    return len(values)


def judge_network(story):
    """NMT: node 18 obeys, the others go on."""
    def of_18(part, base):
        """Its frames since the command of that part."""
        command_at = next(k for k, one in enumerate(story[part]) if not one.is_extended_id and one.arbitration_id == 0)
        return [one for one in story[part][command_at:] if not one.is_extended_id and one.arbitration_id == base + 18]

    def states(part):
        return [one.data[0] for one in of_18(part, 0x700)]

    assert set(states(3)) == {127} and len(of_18(3, 0x180)) <= 1, states(3)
    assert set(states(4)) == {4} and not of_18(4, 0x180) and not of_18(4, 0x580), "a stopped node answers"
    assert set(states(5)) == {5} and len(of_18(5, 0x180)) > 10, states(5)
    assert states(6)[0] == 0 and set(states(6)[1:]) == {5} and len(of_18(6, 0x180)) > 10, states(6)
    for part in (3, 4, 5, 6):
        assert sum(one.arbitration_id == 0x191 for one in story[part]) > 10, part


def judge_addresses(story):
    """The address is sent when asked for, twice here, and lost to a lesser NAME."""
    def named(part, name):
        return [one for one in story[part] if (one.is_extended_id, one.arbitration_id) == name]

    name = bytes(named(0, CLAIMED)[0].data)
    assert [bytes(one.data) for one in named(7, CLAIMED)] == 2 * [name], named(7, CLAIMED)
    contest = named(10, CLAIMED)
    assert [bytes(one.data) for one in contest] == [bytes(8)], contest
    assert [bytes(one.data) for one in named(10, LOST)] == [name], named(10, LOST)
    after = named(10, LOST)[0].timestamp
    assert not [one for one in named(10, FLOW) + named(10, SILENT_FLOW) if one.timestamp > after], "it sends under an address it has lost"
    assert [one for one in story[10] if one.arbitration_id == 0x191 and one.timestamp > after + 2]


def judge_mishaps(story, site):
    """The interface goes down and away: reported while it lasts, and the address is claimed again."""
    for part, lost, back in ((8, "went_down", "came_up"), (9, "went_away", "came_back")):
        assert "vcan0" in site(lost)["trouble"], (lost, site(lost))
        assert site(back)["trouble"] == "" and site(back)["sent"] > site(lost)["sent"], (back, site(back))
        flows = [one for one in story[part] if (one.is_extended_id, one.arbitration_id) == FLOW]
        gap, end = max((after.timestamp - before.timestamp, after.timestamp) for before, after in zip(flows, flows[1:]))
        assert 4 < gap < 15 and sum(one.timestamp > end for one in flows) > 10, (part, gap, len(flows))
        claims = [one.timestamp for one in story[part] if (one.is_extended_id, one.arbitration_id) == CLAIMED]
        assert len(claims) == 1 and end - claims[0] > OBJECTION_S, (part, claims, end)
        print(f"  {lost}: {site(lost)['trouble']!r}; {gap:.1f} s without a frame")
    assert "128 belongs to another" in site("lost")["trouble"], site("lost")


def judge(eds, heard):
    def text(name):
        with open(os.path.join(heard, name), encoding="utf-8") as file:
            return file.read().strip()

    def site(name):
        return json.loads(text(name + ".json"))["outputs"]["can"]

    assert not os.path.exists(os.path.join(heard, "missing")), text("missing")
    judge_starts(text)
    messages = list(can.LogReader(os.path.join(heard, "bus.log")))
    story = parts(messages)
    assert sorted(story) == list(range(11)), sorted(story)
    quiet_s, agreeing = judge_flows(story[0])
    read = judge_objects(story[1], eds)
    assert not [one for one in story[2] if one.arbitration_id in (0x591, 0x594)], "an answer to what was no request"
    judge_network(story)
    judge_addresses(story)
    judge_mishaps(story, site)
    print(f"Linux {text('kernel')}: {len(messages)} frames, {read} objects, {agreeing} flows agree, first {quiet_s:.2f} s after the claim")


if sys.argv[1] == "reads":
    for at in objects(sys.argv[2]):
        print("611#" + sdo_read(*at).hex().upper())
else:
    judge(*sys.argv[2:4])
