-- Version 3: what a machine's control knows before a program starts (tools, offsets, variables, parameters), with every version.

-- Rows are never changed: going back makes a new revision with the old text.
CREATE TABLE setup (
  machine    TEXT NOT NULL,  -- not a reference: it may not have been seen yet
  number     INTEGER NOT NULL CHECK (number > 0),  -- 1, 2, 3 ... per machine
  text       TEXT NOT NULL,  -- TOML
  sha256     BLOB NOT NULL CHECK (length(sha256) = 32),
  comment    TEXT NOT NULL,
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  PRIMARY KEY (machine, number)
) STRICT, WITHOUT ROWID;

ALTER TABLE run ADD COLUMN setup INTEGER;  -- the machine's setup it was started with; NULL: none was stored
