-- Version 2: serial ports, and revisions that wait for acceptance.

-- What came from a machine ('held') runs nowhere until a person accepts it; 'rejected' is hidden for ever.
ALTER TABLE revision ADD COLUMN standing TEXT NOT NULL DEFAULT 'accepted'
  CHECK (standing IN ('accepted', 'held', 'rejected'));
ALTER TABLE revision ADD COLUMN accepted_us INTEGER;  -- when it was accepted; NULL: held, or never held
ALTER TABLE upload ADD COLUMN held INTEGER NOT NULL DEFAULT 0 CHECK (held IN (0, 1));  -- becomes a held revision

CREATE TABLE port (
  name          TEXT PRIMARY KEY,
  machine       TEXT NOT NULL,  -- at its end; not a reference: it may not have been seen yet
  address       TEXT NOT NULL UNIQUE,  -- one port writes to a line
  line_template TEXT NOT NULL,  -- or empty
  rules         TEXT NOT NULL,  -- what a text from the control means (TOML), or empty
  is_enabled    INTEGER NOT NULL CHECK (is_enabled IN (0, 1))
) STRICT, WITHOUT ROWID;

-- A port's own settings, over those of its template.
CREATE TABLE port_setting (
  port     TEXT NOT NULL REFERENCES port (name) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position >= 0),  -- 0, 1, 2 ... as they were given
  key      TEXT NOT NULL,
  value    TEXT NOT NULL,
  PRIMARY KEY (port, position),
  UNIQUE (port, key)
) STRICT, WITHOUT ROWID;
