"""HAL without a LinuxCNC: it has no pin."""


class error(Exception):
    pass


class component:
    def __init__(self, name):
        self.name = name

    def exit(self):
        pass


def get_value(name):
    raise error("Item %s not found" % name)
