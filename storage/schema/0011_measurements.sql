-- Version 11: report templates; what reports say as measurements, and the verdict on each part.

-- Report templates -------------------------------------------------------------------------------

-- Versions are never changed: a measurement names the one it was derived with.
CREATE TABLE report_template (
  name       TEXT NOT NULL,
  version    INTEGER NOT NULL CHECK (version >= 1),
  text       TEXT NOT NULL,  -- TOML (clients/tools/report_template)
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  is_removed INTEGER NOT NULL DEFAULT 0 CHECK (is_removed IN (0, 1)),
  PRIMARY KEY (name, version)
) STRICT, WITHOUT ROWID;

-- Whose records it is for.
CREATE TABLE report_template_assignment (
  scope      TEXT NOT NULL CHECK (scope IN ('program', 'machine', 'macro')),
  subject    TEXT NOT NULL,  -- name of the program, the machine, or the printing macro
  template   TEXT NOT NULL,
  version    INTEGER,        -- NULL: the newest
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  PRIMARY KEY (scope, subject, template)
) STRICT, WITHOUT ROWID;

-- Measurements -----------------------------------------------------------------------------------

-- Up to where the records of each journal are derived. Moved in the transaction that stores what
-- was derived, so each record is derived once.
CREATE TABLE measurement_cursor (
  machine INTEGER NOT NULL REFERENCES machine (id),
  epoch   INTEGER NOT NULL,
  number  INTEGER NOT NULL,
  PRIMARY KEY (machine, epoch)
) STRICT, WITHOUT ROWID;
-- No template was there for what came before.
INSERT INTO measurement_cursor SELECT machine, epoch, last FROM record_epoch;

-- Where the interpretation of its lines is, between two records.
CREATE TABLE measurement_state (
  machine INTEGER PRIMARY KEY REFERENCES machine (id),
  state   TEXT NOT NULL  -- JSON (server/measurements)
) STRICT;

-- What belongs together: a workpiece, by one template.
CREATE TABLE measured_part (
  id            INTEGER PRIMARY KEY,
  machine       INTEGER NOT NULL REFERENCES machine (id),
  run           TEXT,              -- its id; NULL: outside any run
  program       TEXT NOT NULL,     -- its name then; empty: not known
  revision      INTEGER NOT NULL,
  template      TEXT NOT NULL,
  version       INTEGER NOT NULL,  -- of the template
  number        TEXT NOT NULL,     -- of the part, as reported
  serial        TEXT NOT NULL,
  measurements  INTEGER NOT NULL,
  findings      INTEGER NOT NULL,
  verdict       INTEGER NOT NULL CHECK (verdict BETWEEN 0 AND 3),  -- good, unknown, rework, scrap: of all so far
  begun_us      INTEGER NOT NULL,
  ended_us      INTEGER,           -- NULL: lines may follow
  is_superseded INTEGER NOT NULL DEFAULT 0 CHECK (is_superseded IN (0, 1)),  -- derived again
  FOREIGN KEY (template, version) REFERENCES report_template (name, version)
) STRICT;
-- Given last; no number is used twice, also when retention took the newest part.
CREATE TABLE measured_part_number (
  last INTEGER NOT NULL
) STRICT;
INSERT INTO measured_part_number VALUES (0);
CREATE INDEX measured_part_by_run ON measured_part (run) WHERE run IS NOT NULL;
CREATE INDEX measured_part_by_machine ON measured_part (machine, begun_us);

CREATE TABLE characteristic_name (
  id   INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE
) STRICT;
-- What a characteristic had to be; the same for most of its measurements.
CREATE TABLE characteristic (
  id       INTEGER PRIMARY KEY,
  name     INTEGER NOT NULL REFERENCES characteristic_name (id),
  nominal  REAL,              -- in `unit`, like all values
  lower    REAL,              -- still good; NULL: not limited on that side
  upper    REAL,
  unit     TEXT NOT NULL,
  decimals INTEGER NOT NULL,  -- that the report has
  tool     TEXT NOT NULL      -- that cuts it; may be empty
) STRICT;
CREATE UNIQUE INDEX characteristic_by_value ON characteristic (name, nominal, lower, upper, unit, decimals, tool);

CREATE TABLE measurement (
  id             INTEGER PRIMARY KEY,
  part           INTEGER NOT NULL REFERENCES measured_part (id),
  machine        INTEGER NOT NULL,  -- the part's
  name           INTEGER NOT NULL,  -- the characteristic's
  characteristic INTEGER NOT NULL REFERENCES characteristic (id),
  epoch          INTEGER NOT NULL,  -- and number: the record it was derived from
  number         INTEGER NOT NULL,
  item           INTEGER NOT NULL,  -- of the record's, from 0
  time_us        INTEGER NOT NULL,  -- at the gateway
  actual         REAL NOT NULL,
  verdict        INTEGER NOT NULL CHECK (verdict BETWEEN 0 AND 3),
  block          INTEGER NOT NULL,
  line           INTEGER NOT NULL,
  is_superseded  INTEGER NOT NULL DEFAULT 0 CHECK (is_superseded IN (0, 1))
) STRICT;
-- A record is derived once, whatever the cursor says.
CREATE UNIQUE INDEX measurement_by_record ON measurement (machine, epoch, number, item) WHERE is_superseded = 0;
CREATE INDEX measurement_by_characteristic ON measurement (machine, name, time_us);
CREATE INDEX measurement_by_time ON measurement (machine, time_us);
CREATE INDEX measurement_by_part ON measurement (part);
CREATE INDEX measurement_outside ON measurement (machine, time_us) WHERE verdict >= 2;

-- What could not be understood, and lines that are missing, doubled or out of order.
CREATE TABLE report_finding (
  id            INTEGER PRIMARY KEY,
  machine       INTEGER NOT NULL REFERENCES machine (id),
  part          INTEGER REFERENCES measured_part (id),  -- NULL: of none
  run           TEXT,
  epoch         INTEGER NOT NULL,  -- and number: the record at which it was found
  number        INTEGER NOT NULL,
  time_us       INTEGER NOT NULL,
  kind          TEXT NOT NULL,
  text          TEXT NOT NULL,
  is_superseded INTEGER NOT NULL DEFAULT 0 CHECK (is_superseded IN (0, 1))
) STRICT;
CREATE INDEX report_finding_by_run ON report_finding (run) WHERE run IS NOT NULL;
CREATE INDEX report_finding_by_machine ON report_finding (machine, time_us);
CREATE INDEX report_finding_by_part ON report_finding (part) WHERE part IS NOT NULL;

-- Archives ---------------------------------------------------------------------------------------

-- What retention took out of the tables, in files that can be read back.
CREATE TABLE archive (
  id         INTEGER PRIMARY KEY,
  kind       TEXT NOT NULL CHECK (kind IN ('records', 'measurements')),
  machine    TEXT NOT NULL,         -- of records; of measurements empty: of all
  epoch      INTEGER NOT NULL,      -- of records: their journal
  first      INTEGER NOT NULL,      -- numbers of the records, or ids of the parts
  last       INTEGER NOT NULL,
  is_removed INTEGER NOT NULL DEFAULT 0 CHECK (is_removed IN (0, 1)),  -- its rows are no longer in the tables
  file       TEXT NOT NULL UNIQUE,  -- its name in the folder of archives
  sha256     BLOB NOT NULL CHECK (length(sha256) = 32),  -- of the file; also in its audit entry
  rows       INTEGER NOT NULL,
  bytes      INTEGER NOT NULL,      -- of the file
  first_us   INTEGER NOT NULL,
  last_us    INTEGER NOT NULL,
  created_us INTEGER NOT NULL
) STRICT;
