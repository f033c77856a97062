"""The gateway's orders to LinuxCNC. The first part of the helper's text; helper.py is the second.

A command blocks until LinuxCNC's task has taken it, five seconds at most, and some are followed by others. So each order is carried out
by a process of its own, one after another. A stop waits for none of them, and what an order before it has not sent by then is not sent.
"""
import collections
import json
import mmap
import os
import time

COMMAND_WAIT = 2.0
TAKEN_WAIT = 1.0  # after the five seconds of LinuxCNC's module
STOPS = ("pause", "stop_jog", "abort", "emergency")  # the strongest last
HARMLESS = ("override",)  # starts nothing, and is in force after a stop too


class Overtaken(Exception):
    """A stop came before the order's next command, or the helper has ended."""


class Unanswered(Exception):
    """LinuxCNC's task takes no commands: its status is an old one."""


class Commands:
    def __init__(self, command, stat):
        self.command = command
        self.stat = stat
        self.stops = mmap.mmap(-1, 8)  # counted for the processes of orders
        self.helper = os.getpid()
        self.count = None  # at the order's start

    def count_stop(self):
        self.stops[:] = (int.from_bytes(self.stops[:], "big") + 1).to_bytes(8, "big")

    def check(self):
        if self.count is not None and (self.stops[:] != self.count or os.getppid() != self.helper):
            raise Overtaken

    def is_taken(self):
        self.stat.poll()
        return self.stat.echo_serial_number - self.command.serial >= 0

    def send(self, call, *arguments):
        self.check()
        call(*arguments)
        if not self.is_taken():
            self.command.wait_complete(TAKEN_WAIT)
            if not self.is_taken():
                raise Unanswered

    def complete(self):
        end = time.monotonic() + COMMAND_WAIT
        while time.monotonic() < end:
            self.check()
            if self.command.wait_complete(0.02) != -1:
                return

    def to_mode(self, mode):
        self.stat.poll()
        if self.stat.task_mode != mode:
            self.send(self.command.mode, mode)
            self.complete()

    def do(self, order):
        c = self.command
        what = order["do"]
        self.count = None if what in STOPS + HARMLESS else self.stops[:]
        if what == "run":
            self.to_mode(linuxcnc.MODE_AUTO)
            self.send(c.set_optional_stop, False)
            self.send(c.set_block_delete, False)
            self.send(c.program_open, order["file"])
            self.complete()
            self.send(c.auto, linuxcnc.AUTO_RUN, 0)
        elif what == "pause":
            self.send(c.auto, linuxcnc.AUTO_PAUSE)
        elif what == "resume":
            self.send(c.auto, linuxcnc.AUTO_RESUME)
        elif what == "abort":
            self.send(c.abort)
        elif what == "override":
            self.send(c.feedrate, order["feed"])
            self.send(c.rapidrate, order["rapid"])
            self.send(c.spindleoverride, order["spindle"])
        elif what == "emergency":
            self.send(c.state, linuxcnc.STATE_ESTOP)
        elif what == "reset":
            self.send(c.state, linuxcnc.STATE_ESTOP_RESET)
            self.complete()
        elif what == "on":
            self.send(c.state, linuxcnc.STATE_ON)
            self.complete()
        elif what == "home":
            self.send(c.state, linuxcnc.STATE_ON)
            self.complete()
            self.to_mode(linuxcnc.MODE_MANUAL)
            self.send(c.teleop_enable, 0)
            self.complete()
            self.send(c.home, -1)
        elif what == "jog":
            return self.jog(order)
        elif what == "stop_jog":
            self.send(c.jog, linuxcnc.JOG_STOP, 0, order["axis"])
        else:
            return "unknown command " + what
        return ""

    def jog(self, order):
        """By one step along an axis of the machine; LinuxCNC ends it by itself."""
        self.to_mode(linuxcnc.MODE_MANUAL)
        self.send(self.command.teleop_enable, 1)
        self.complete()
        self.stat.poll()
        if self.stat.task_mode != linuxcnc.MODE_MANUAL or self.stat.motion_mode != linuxcnc.TRAJ_MODE_TELEOP:
            return "it does not change to manual mode with axes that move together"
        self.send(self.command.jog, linuxcnc.JOG_INCREMENT, 0, order["axis"], order["velocity"], order["distance"])
        self.complete()
        return ""


class Orders:
    """Who carries out what, and what waits."""

    def __init__(self, machine):
        self.machine = machine
        self.waiting = collections.deque()
        self.running = {}  # by the end of its pipe
        self.repeated = None  # a stop that has overtaken an order

    def take(self, order):
        if order["do"] == "hal":
            say(signal(order["name"]))
            self.answer(order)
        elif order["do"] in STOPS:
            self.stop(order)
        else:
            self.waiting.append(order)
            self.start_next()

    def answer(self, order, problem=""):
        if order["n"] is not None:
            say({"done": order["n"], "problem": problem})

    def stop(self, order):
        """The order in hand may be at a command just now, which then comes after the stop: the stop is sent again."""
        self.machine.commands.count_stop()
        for other in [other for other in self.waiting if other["do"] not in HARMLESS]:
            self.waiting.remove(other)
            self.answer(other)
        if any(other["do"] not in HARMLESS for other in self.running.values()):
            self.repeated = max(dict(order, n=None), self.repeated or order, key=lambda stop: STOPS.index(stop["do"]))
        self.start(order)

    def start_next(self):
        if self.running:
            return
        if self.repeated:
            order, self.repeated = self.repeated, None
            self.start(order)
        elif self.waiting:
            self.start(self.waiting.popleft())

    def start(self, order):
        self.machine.note(order)
        end, mine = os.pipe()
        if os.fork() == 0:
            try:
                os.close(0)
                os.close(1)
                os.write(mine, json.dumps(self.carry_out(order)).encode())
            finally:
                os._exit(0)
        os.close(mine)
        self.running[end] = order

    def carry_out(self, order):
        try:
            return self.machine.commands.do(order)
        except Overtaken:
            return ""
        except Unanswered:
            return None
        except (linuxcnc.error, KeyError, ValueError) as error:
            return str(error) or "refused"

    def take_answers(self, ready):
        for end in [end for end in ready if end in self.running]:
            order, result = self.running.pop(end), os.read(end, 65536)
            os.close(end)
            os.wait()
            problem = json.loads(result) if result else "the order was not carried out"
            if problem is None:
                give_up("LinuxCNC takes no commands")
            self.machine.stat.poll()
            self.answer(order, problem)
        self.start_next()
