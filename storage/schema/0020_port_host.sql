-- Version 20: servers that share a library know which of them has a port's device.

-- The computer that has the device of this port; empty: not known, or the address is not a device of one computer.
ALTER TABLE port ADD COLUMN host TEXT NOT NULL DEFAULT '';
