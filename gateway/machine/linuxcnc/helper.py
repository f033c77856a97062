"""Status and commands of a running LinuxCNC, as JSON lines on stdin and stdout.

A gateway starts it (helper_link.cpp): python3 -c TEXT INI. It is a program of its own because LinuxCNC's interface is a module for
Python, and because that module may block for seconds. It holds no state of the program. When stdin ends, the gateway is gone: what
it has started is aborted. When LinuxCNC's task ends, what the task has given to the motion process is stopped.

The text of helper_orders.py comes before this text.
"""
import json
import os
import re
import select
import sys
import time

STATUS_PERIOD = 0.008  # while something changes
STILL_PERIOD = 0.1  # else: shows that the helper is alive
LEAVE_WAIT = 0.8  # the gateway kills a helper that takes longer than a second
STANDSTILL_WAIT = 3.0


def say(message):
    sys.stdout.write(json.dumps(message, separators=(",", ":")) + "\n")
    sys.stdout.flush()


def give_up(text):
    say({"fatal": text})
    sys.exit(1)


try:
    import hal
    import linuxcnc
except ImportError as error:
    give_up("the module linuxcnc is missing: %s" % error)


def process_named(name):
    """LinuxCNC allows one in a system; several are told apart by nothing."""
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open("/proc/%s/comm" % pid, encoding="utf-8") as comm:
                if comm.read().strip() == name[:15]:
                    return int(pid)
        except OSError:
            continue
    return None


def share_home_of(pid):
    """LinuxCNC keeps its tool table in a file in the home folder that it was started with, and without it there is no status."""
    try:
        with open("/proc/%d/environ" % pid, "rb") as environ:
            homes = [line[5:] for line in environ.read().split(b"\0") if line.startswith(b"HOME=")]
    except OSError:  # another user's
        return
    if homes:
        os.environb[b"HOME"] = homes[0]


def set_pin(name, text):
    try:
        hal.set_p(name, text)
    except (RuntimeError, hal.error):  # a signal of the builder's drives it, which must not undo this
        hal.disconnect(name)
        hal.set_p(name, text)


def stop_motion():
    """Without a task there is no command, but the motion continues with what it has. Its pins stop it: along the path, then the drives."""
    component = hal.component("dripline-stop-%d" % os.getpid())
    component.ready()
    set_pin("motion.feed-inhibit", "1")
    end, still = time.monotonic() + STANDSTILL_WAIT, 0
    while still < 5 and time.monotonic() < end:
        still = still + 1 if hal.get_value("motion.current-vel") == 0 else 0
        time.sleep(0.004)
    set_pin("motion.enable", "0")
    return component  # a component that is collected ends the connection with HAL


def leaves_adaptive(code):
    """Whether adaptive feed is on (M52) after a startup code."""
    words = re.sub(r"\([^)]*\)|;.*|\s", "", code).upper()
    if not re.search(r"M0*52(?![\d.])", words):
        return False
    number = re.search(r"P([-+]?[\d.]+)", words)
    return number is None or float(number[1]) != 0


def signal(name):
    """A HAL pin, parameter or signal as it is now."""
    component = hal.component("dripline-read-%d" % os.getpid())
    try:
        value = hal.get_value(name)
    except (RuntimeError, hal.error) as error:
        return {"signal": name, "problem": str(error) or "it is not there"}
    finally:
        component.exit()
    if not isinstance(value, (bool, int, float)):
        return {"signal": name, "problem": "its value is no number"}
    return {"signal": name, "value": float(value)}


class Machine:
    def __init__(self, ini_path):
        if not os.path.isfile(ini_path):
            give_up("%s is no file" % ini_path)
        self.ini_path = os.path.realpath(ini_path)
        self.ini = linuxcnc.ini(self.ini_path)
        folder = os.path.dirname(self.ini_path)
        nml = self.ini.find("EMC", "NML_FILE")
        if nml:
            linuxcnc.nmlfile = os.path.join(folder, nml)
        task = os.path.basename(self.ini.find("TASK", "TASK") or "milltask")
        pid = process_named(task)
        if pid is None:
            give_up("LinuxCNC is not running here: there is no process %s" % task)
        share_home_of(pid)
        realtime = process_named("rtapi_app")
        self.lives = [os.pidfd_open(number) for number in (pid, realtime) if number is not None]
        self.task = self.lives[0]
        try:
            self.stat = linuxcnc.stat()
            self.command = linuxcnc.command()
            self.errors = linuxcnc.error_channel()
            self.wait_for_status()
        except linuxcnc.error as error:
            give_up("LinuxCNC does not answer: %s" % error)
        except SystemError:
            give_up("LinuxCNC's tool table %s/.tool.mmap cannot be read: the gateway must be of the user who started LinuxCNC"
                    % os.environ.get("HOME", ""))
        if os.path.realpath(self.stat.ini_filename) != self.ini_path:
            give_up("LinuxCNC runs %s, not %s" % (self.stat.ini_filename, self.ini_path))
        self.has_program = False
        self.file = None
        self.jogged_axis = None
        self.has_homed = False
        self.commands = Commands(self.command, self.stat)

    def wait_for_status(self):
        end = time.monotonic() + 5
        while time.monotonic() < end:
            self.stat.poll()
            if self.stat.ini_filename and self.stat.axis_mask:
                return
            time.sleep(0.02)
        give_up("LinuxCNC has not started completely")

    def number(self, section, key):
        try:
            return float(self.ini.find(section, key))
        except (TypeError, ValueError):
            return 0.0

    def is_on(self, section, key):
        return (self.ini.find(section, key) or "0").strip().lower() not in ("0", "no", "n", "false", "f", "off", "")

    def introduce(self):
        s = self.stat
        code = next(filter(None, (self.ini.find(section, "RS274NGC_STARTUP_CODE") for section in ("RS274NGC", "EMC"))), "")
        settings = [key for key in ("RETAIN_G43", "DISABLE_AUTO_G54") if self.is_on("RS274NGC", key)]
        say({
            "hello": 1,
            "version": linuxcnc.version,
            "units": s.linear_units,
            "axes": s.axis_mask,
            "limits": [[a["min_position_limit"], a["max_position_limit"]] for a in s.axis[:9]],
            "velocity": [self.number("AXIS_" + letter, "MAX_VELOCITY") for letter in "XYZABCUVW"],
            "acceleration": [self.number("AXIS_" + letter, "MAX_ACCELERATION") for letter in "XYZABCUVW"],
            "rpm": self.number("SPINDLE_0", "MAX_FORWARD_VELOCITY"),
            "wrapped": sum(1 << i for i, letter in enumerate("XYZABCUVW") if self.number("AXIS_" + letter, "WRAPPED_ROTARY") != 0),
            "startup_code": code,
            "adaptive": leaves_adaptive(code),
            "settings": ", ".join("[RS274NGC]" + key for key in settings),
            "read_ahead": int(self.number("TASK", "INTERP_MAX_LEN") or 1000),
        })

    def status(self):
        s = self.stat
        joints = s.joints
        return {
            "state": s.task_state,
            "mode": s.task_mode,
            "interp": s.interp_state,
            "exec": s.exec_state,
            "read": s.read_line,
            "motion": s.motion_id,
            "queue": s.queue,
            "inpos": bool(s.inpos),
            "paused": bool(s.paused or s.interp_state == linuxcnc.INTERP_PAUSED),
            "homed": all(s.homed[:joints]),
            "homing": self.homes(),
            "at": list(s.position),
            "actual": list(s.actual_position),
            "velocity": s.current_vel,
            "offset": any(s.g92_offset) or any(s.g5x_offset) or any(s.tool_offset) or s.rotation_xy != 0,
            "system": s.g5x_index,
            "tool": s.tool_in_spindle,
            "spindle": s.spindle[0]["speed"] if s.spindle[0]["enabled"] else 0.0,
            "tripped": bool(s.probe_tripped),
            "touching": bool(s.probe_val),
            "adaptive": bool(s.adaptive_feed_enabled),
            "probing": bool(s.probing),
            "probed": list(s.probed_position),
            "inputs": sum(1 << i for i, value in enumerate(s.din[:32]) if value),
            "inputs_above": sum(1 << i for i, value in enumerate(s.din[32:64]) if value),
            "echo": s.echo_serial_number,
        }

    def note(self, order):
        """What `leave` has to stop."""
        what = order["do"]
        if what == "run":
            self.has_program, self.file = True, order["file"]
        elif what == "home":
            self.has_homed = True
        elif what == "jog":
            self.jogged_axis = order["axis"]
        elif what == "stop_jog":
            self.jogged_axis = None
        elif what == "emergency":
            self.has_program = False
        elif what == "abort":
            self.has_program = self.has_homed = False

    def homes(self):
        return any(j["homing"] for j in self.stat.joint[:self.stat.joints])

    def is_homing(self):
        """Or was only just commanded to."""
        self.stat.poll()
        return self.homes() or not all(self.stat.homed[:self.stat.joints])

    def leave(self):
        self.commands.count_stop()
        if self.jogged_axis is not None:
            self.command.jog(linuxcnc.JOG_STOP, 0, self.jogged_axis)
        if self.has_program:
            self.command.abort()
            self.remove_program()
            self.command.wait_complete(LEAVE_WAIT)
        elif self.has_homed and self.is_homing():
            self.command.abort()
            self.command.wait_complete(LEAVE_WAIT)
        os._exit(0)  # stdout may be gone: nothing to flush

    def remove_program(self):
        """A gateway that was killed has left it."""
        try:
            os.unlink(self.file)
            os.rmdir(os.path.dirname(self.file))
        except OSError:
            pass

    def lose_task(self):
        """Stops the motion, and reports how far it has come, as the motion process has it."""
        try:
            component = stop_motion()
            self.say_reached()
            component.exit()
        except (RuntimeError, hal.error) as error:
            give_up("LinuxCNC has ended, and the motion it has left cannot be stopped: %s" % error)

    def say_reached(self):
        status = self.status()
        status.update(motion=max(0, hal.get_value("motion.program-line")), velocity=0.0)
        for i, letter in enumerate("xyzabcuvw"):
            if self.stat.axis_mask >> i & 1:
                status["at"][i] = hal.get_value("axis.%s.pos-cmd" % letter)
        say({"status": status})


def read_orders(machine, orders, buffer):
    try:
        data = os.read(0, 65536)
    except OSError:
        data = b""
    if not data:
        machine.leave()
    *lines, rest = (buffer + data).split(b"\n")
    for line in lines:
        orders.take(json.loads(line))
    return rest


def serve(machine):
    buffer, last, last_said = b"", None, 0.0
    orders = Orders(machine)
    while True:
        ready, _, _ = select.select([0, *machine.lives, *orders.running], [], [], STATUS_PERIOD)
        ended = [life for life in machine.lives if life in ready]
        if ended:
            machine.commands.count_stop()
            if ended == [machine.task]:
                machine.lose_task()
            give_up("LinuxCNC has ended")
        if 0 in ready:
            buffer = read_orders(machine, orders, buffer)
        if any(end in ready for end in orders.running):
            orders.take_answers(ready)
            last = None  # what a command has done is reported
        machine.stat.poll()
        for _ in range(20):
            message = machine.errors.poll()
            if not message:
                break
            say({"message": message[0], "text": message[1]})
        status, now = machine.status(), time.monotonic()
        if status != last or now - last_said >= STILL_PERIOD:
            say({"status": status})
            last, last_said = status, now


def main():
    machine = None
    try:
        machine = Machine(sys.argv[1])
        machine.introduce()
        say({"status": machine.status()})  # before any command changes it
        serve(machine)
    except OSError:  # the gateway is gone
        if machine is not None:
            machine.leave()
        os._exit(1)


main()
