"""Commands that nobody may obey, as docs/messages.md has them: none gets a reply, and `sprung status` names each. Those of
an operator, and those of a program in the planner's place."""

import hashlib
import json
import time

import lcm


def with_mac(channel, message, key):
    content = message.encode()[:-16]
    return content + hashlib.blake2b(channel.encode() + b"\0" + content, digest_size=16, key=key).digest()


def check(robot, place):
    """@param place the folder of its run file and key."""
    run = json.loads((place / "default.json").read_text())
    key = (place / "default.key").read_bytes()
    check_operators(robot, run, key)
    check_legs(robot, run, key)


def waits_for(robot, channel):
    def named(what):
        robot.wait_for(lambda: f"{channel} refused: {what}" in robot.ask("status").stdout, f"'{what}' in status", 10)

    return named


def check_legs(robot, run, key):
    """What the planner has sent, once more with one thing changed."""
    import sprung_msgs  # pylint: disable=import-outside-toplevel; generated just now

    network, heard = lcm.LCM(run["lcm_url"]), []
    network.subscribe("LEG_COMMAND", lambda _, data: heard.append(sprung_msgs.leg_command_t.decode(data)))
    robot.wait_for(lambda: network.handle_timeout(100) > 0, "a LEG_COMMAND", 10)
    named = waits_for(robot, "LEG_COMMAND")

    def send(change, what):
        command = heard[-1]
        change(command)
        network.publish("LEG_COMMAND", with_mac("LEG_COMMAND", command, key))
        named(what)
        while network.handle_timeout(0):
            pass  # our own and old ones
        heard.clear()
        robot.wait_for(lambda: network.handle_timeout(100) > 0, "a newer LEG_COMMAND", 10)

    def unknown_mode(command):
        command.legs[0].control_mode = 99

    def foreign(command):
        command.session += 1

    def stale(command):
        command.seq -= 100
        command.utime -= 1

    send(unknown_mode, "bad value, found 99, expected 0 to 4")
    send(foreign, "wrong session")
    send(stale, "replayed")
    assert "operational" in robot.ask("status").stdout, "the planner is obeyed meanwhile"


def check_operators(robot, run, key):
    import sprung_msgs  # pylint: disable=import-outside-toplevel; generated just now

    network, replies = lcm.LCM(run["lcm_url"]), []
    network.subscribe("OPERATOR_REPLY", lambda _, data: replies.append(sprung_msgs.operator_reply_t.decode(data)))

    def send(kind=sprung_msgs.operator_kind_t.SIT, session=run["session"], age_us=0, key=key):
        command = sprung_msgs.operator_command_t()
        command.kind, command.session, command.apply_at_seq, command.mac = kind, session, -1, bytes(16)
        command.request_id = command.utime = time.monotonic_ns() // 1000 - run["epoch_us"] - age_us
        message = with_mac("OPERATOR_COMMAND", command, key)
        network.publish("OPERATOR_COMMAND", message)
        return message, command.request_id

    named = waits_for(robot, "OPERATOR_COMMAND")
    _, unknown = send(kind=99)
    named("bad value, found 99, expected 0 to 15")
    _, foreign = send(session=run["session"] + 1)
    named("wrong session")
    _, old = send(age_us=3_000_000)
    named("late")
    _, forged = send(key=bytes(32))
    named("forged")
    again, _ = send(kind=sprung_msgs.operator_kind_t.STOP)
    robot.wait_for(lambda: network.handle_timeout(100) > 0, "a reply to what may be obeyed", 10)
    network.publish("OPERATOR_COMMAND", again)
    named("replayed")
    while network.handle_timeout(200):
        pass
    answered = {reply.request_id for reply in replies} & {unknown, foreign, old, forged}
    assert not answered, f"answered, though nobody may be: {answered}"
