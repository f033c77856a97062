-- Version 6: the place of the server that writes is a lease with a fencing term, servers that wait for it are known, and a port's device has a computer.

-- Each taking of the place gets a higher term, in the transaction that takes it; every transaction that writes compares it. At least the seconds
-- since 1970 by the database's clock, so that a database that was restored from a backup begins above the terms that were given since.
ALTER TABLE store_holder ADD COLUMN term bigint NOT NULL DEFAULT 0 CHECK (term >= 0);
ALTER TABLE store_holder ADD COLUMN url text COLLATE "C" NOT NULL DEFAULT '';  -- where programs and people reach that server; empty: nowhere yet
ALTER TABLE store_holder ADD COLUMN signing_key text COLLATE "C" NOT NULL DEFAULT '';  -- public, hexadecimal, of the server that had the place last

-- Servers that wait for the place. Nothing depends on these rows: they are for people, and for a hand-over.
CREATE TABLE store_standby (
  holder text COLLATE "C" PRIMARY KEY,
  described text COLLATE "C" NOT NULL,
  seen timestamptz NOT NULL
);

-- The computer that has the device of this port; empty: not known, or the address is not a device of one computer.
ALTER TABLE port ADD COLUMN host text COLLATE "C" NOT NULL DEFAULT '';
