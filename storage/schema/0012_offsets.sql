-- Version 12: corrections of tool wear and work offsets, proposed from measurements.

-- What follows from deviations on a machine, every version of it.
CREATE TABLE offset_rules (
  machine    TEXT NOT NULL,
  version    INTEGER NOT NULL CHECK (version >= 1),
  text       TEXT NOT NULL,  -- TOML (server/offsets)
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  PRIMARY KEY (machine, version)
) STRICT, WITHOUT ROWID;

CREATE TABLE offset_proposal (
  id         INTEGER PRIMARY KEY AUTOINCREMENT,  -- never used again
  machine    TEXT NOT NULL,
  rule       TEXT NOT NULL,     -- its name in the rules
  target     TEXT NOT NULL,     -- T3.wear.X, G54.Z, #500
  unit       TEXT NOT NULL,     -- of both values: mm or in, the setup's
  old_value  REAL NOT NULL,
  new_value  REAL NOT NULL,
  base       INTEGER NOT NULL,  -- the setup it was made from; 0: there was none
  state      TEXT NOT NULL DEFAULT 'pending' CHECK (state IN ('pending', 'applied', 'rejected', 'superseded')),
  used       INTEGER NOT NULL,  -- measurements
  left_out   INTEGER NOT NULL,  -- outliers
  mean       REAL NOT NULL,     -- deviation, in the characteristic's unit
  first      INTEGER NOT NULL,  -- measurement, by its id
  last       INTEGER NOT NULL,
  reasons    TEXT NOT NULL,     -- JSON array of texts
  created_us INTEGER NOT NULL,
  decided_us INTEGER,           -- NULL: pending
  who        TEXT NOT NULL DEFAULT '',
  comment    TEXT NOT NULL DEFAULT '',
  is_automatic INTEGER NOT NULL DEFAULT 0 CHECK (is_automatic IN (0, 1)),  -- applied within the policy, without a person
  setup      INTEGER,           -- applied: the setup that it became
  CHECK ((state = 'applied') = (setup IS NOT NULL))
) STRICT;
-- One at a time for each value: a newer one supersedes it.
CREATE UNIQUE INDEX offset_proposal_pending ON offset_proposal (machine, target) WHERE state = 'pending';
CREATE INDEX offset_proposal_by_machine ON offset_proposal (machine, id);
CREATE UNIQUE INDEX offset_proposal_by_setup ON offset_proposal (machine, setup) WHERE setup IS NOT NULL;
-- Which runs were cut under a setup.
CREATE INDEX run_by_setup ON run (machine, setup) WHERE setup IS NOT NULL;
