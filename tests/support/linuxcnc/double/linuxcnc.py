"""LinuxCNC's module for Python without a LinuxCNC, for tests of the helper. Its state is beside the INI file: `sent` has the commands, a
line each, and `busy` how many of them LinuxCNC's task has taken; without that file it takes each at once.
"""
import os
import sys
import time

MODE_MANUAL, MODE_AUTO = 1, 2
STATE_ESTOP, STATE_ESTOP_RESET, STATE_ON = 1, 2, 4
INTERP_IDLE, INTERP_PAUSED = 1, 3
JOG_STOP, JOG_INCREMENT = 0, 2
AUTO_RUN, AUTO_PAUSE, AUTO_RESUME = 0, 1, 2
TRAJ_MODE_TELEOP = 3
COMMAND_TIMEOUT = 5.0
FOLDER = os.path.dirname(os.path.realpath(sys.argv[1]))

version = "2.9"
nmlfile = ""


class error(Exception):
    pass


def lines_of(name):
    try:
        with open(os.path.join(FOLDER, name), encoding="utf-8") as file:
            return file.read().splitlines()
    except OSError:
        return []


def taken():
    busy = lines_of("busy")
    return int(busy[0]) if busy else len(lines_of("sent"))


class ini:
    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.values = dict(line.strip().split(" = ") for line in file if " = " in line)

    def find(self, _, key):
        return self.values.get(key)


class stat:
    def __init__(self):
        self.ini_filename, self.axis_mask, self.linear_units, self.joints = sys.argv[1], 7, 1.0, 3
        self.axis = [{"min_position_limit": -100.0, "max_position_limit": 100.0}] * 9
        self.joint = [{"homing": 0}] * 3
        self.homed = (1,) * 3
        self.position = self.actual_position = self.probed_position = (0.0,) * 9
        self.g92_offset = self.g5x_offset = self.tool_offset = (0.0,) * 9
        self.spindle = [{"speed": 0.0, "enabled": 0}]
        self.din = (0,) * 64
        self.interp_state, self.exec_state, self.g5x_index, self.inpos = INTERP_IDLE, 2, 1, True
        self.read_line = self.motion_id = self.queue = self.paused = self.tool_in_spindle = 0
        self.current_vel = self.rotation_xy = 0.0
        self.probe_tripped = self.probe_val = self.probing = self.adaptive_feed_enabled = 0
        self.poll()

    def poll(self):
        sent = [line.split() for line in lines_of("sent")[:taken()]]
        self.echo_serial_number = len(sent)
        self.task_mode = next((int(words[1]) for words in reversed(sent) if words[0] == "mode"), MODE_AUTO)
        self.task_state = next((int(words[1]) for words in reversed(sent) if words[0] == "state"), STATE_ON)
        self.motion_mode = TRAJ_MODE_TELEOP if ["teleop_enable", "1"] in sent else 1


class command:
    """Each call blocks until the task has taken the command, or five seconds."""

    def __init__(self):
        self.serial = 0

    def __getattr__(self, name):
        return lambda *arguments: self.write(" ".join(map(str, (name, *arguments))))

    def write(self, text):
        with open(os.path.join(FOLDER, "sent"), "a", encoding="utf-8") as file:
            file.write(text + "\n")
        self.serial = len(lines_of("sent"))
        self.wait_complete(COMMAND_TIMEOUT)

    def wait_complete(self, limit):
        end = time.monotonic() + limit
        while taken() < self.serial:
            if time.monotonic() > end:
                return -1
            time.sleep(0.005)
        return 1


class error_channel:
    def poll(self):
        return None
