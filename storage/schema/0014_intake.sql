-- Version 14: hot folders: which files were taken, and what became of them; the job queues of machines; webhooks and their events.

-- One row for each file. A file is the same one as long as its folder, name, content and time of change are the same: so one
-- that is posted again after its row was finished is another file, and one that is met again after a kill is not.
CREATE TABLE folder_file (
  id         INTEGER PRIMARY KEY AUTOINCREMENT,  -- never used twice: an upload names it
  folder     TEXT NOT NULL,  -- its name in the configuration
  name       TEXT NOT NULL,  -- of the file
  sha256     BLOB NOT NULL CHECK (length(sha256) = 32),
  size       INTEGER NOT NULL CHECK (size >= 0),
  changed_ns INTEGER NOT NULL,  -- the file's time of change, nanoseconds since 1970
  state      TEXT NOT NULL CHECK (state IN ('taken', 'stored', 'failed')),
  program    TEXT NOT NULL DEFAULT '',  -- stored: its name then
  revision   INTEGER,                   -- stored
  reason     TEXT NOT NULL DEFAULT '',  -- failed: why, for people
  target     TEXT NOT NULL DEFAULT '',  -- below the folder, where it is moved; empty: not chosen yet
  taken_us   INTEGER NOT NULL,
  moved_us   INTEGER                    -- NULL: it is still in its folder
) STRICT;
CREATE UNIQUE INDEX folder_file_unfinished ON folder_file (folder, name) WHERE moved_us IS NULL;
CREATE INDEX folder_file_by_folder ON folder_file (folder, state);

-- The file that an upload came from. Its row is stored in the transaction that makes the revision.
ALTER TABLE upload ADD COLUMN folder_file INTEGER;

-- The job queue of each machine: programs in their order, with the number of parts that are wanted.

CREATE TABLE job (
  id            INTEGER PRIMARY KEY AUTOINCREMENT,
  machine       INTEGER NOT NULL REFERENCES machine (id),
  position      INTEGER NOT NULL,  -- order within the machine; gaps mean nothing
  program       INTEGER NOT NULL REFERENCES program (id),
  revision      INTEGER,           -- NULL: the latest that may run when it is started
  quantity      INTEGER NOT NULL CHECK (quantity >= 1),       -- parts that are wanted
  parts_per_run INTEGER NOT NULL CHECK (parts_per_run >= 1),
  comment       TEXT NOT NULL,
  author        TEXT NOT NULL,
  created_us    INTEGER NOT NULL,
  removed_us    INTEGER            -- NULL: it is in the queue
) STRICT;
CREATE INDEX job_by_machine ON job (machine, position);

-- A machine whose queue starts nothing.
CREATE TABLE job_hold (
  machine  INTEGER PRIMARY KEY REFERENCES machine (id),
  who      TEXT NOT NULL,
  reason   TEXT NOT NULL,
  since_us INTEGER NOT NULL
) STRICT;

-- The job that a run is of. Parts are counted from the completed runs, and nowhere kept as a number: a kill can make none wrong.
ALTER TABLE run ADD COLUMN job INTEGER REFERENCES job (id);
CREATE INDEX run_by_job ON run (job, state) WHERE job IS NOT NULL;

-- Webhooks, and the events that they deliver. Triggers write an event in the transaction of the change itself, whoever makes it: none
-- can be forgotten by a caller, and a kill loses none. Without a webhook there are no events.

CREATE TABLE webhook (
  id               INTEGER PRIMARY KEY AUTOINCREMENT,
  name             TEXT NOT NULL UNIQUE,
  url              TEXT NOT NULL,
  secret           TEXT NOT NULL,     -- signs what is sent; it must be readable for that
  kinds            TEXT NOT NULL,     -- of events, with commas; empty: all
  author           TEXT NOT NULL,
  created_us       INTEGER NOT NULL,
  delivered        INTEGER NOT NULL,  -- the last event that was delivered, or passed over
  delivered_us     INTEGER,           -- when
  failures         INTEGER NOT NULL DEFAULT 0,  -- since the last success
  failing_since_us INTEGER,           -- NULL: it is not failing
  fault            TEXT NOT NULL DEFAULT '',    -- of the last failure
  lost             INTEGER NOT NULL DEFAULT 0   -- events that were dropped before they could be delivered
) STRICT;

CREATE TABLE event (
  id      INTEGER PRIMARY KEY AUTOINCREMENT,  -- in the order of their transactions; never used twice
  time_us INTEGER NOT NULL,                   -- when it was stored
  kind    TEXT NOT NULL,                      -- revision, run, alarm, import, job, part
  data    TEXT NOT NULL                       -- JSON
) STRICT;

CREATE TRIGGER event_of_new_revision AFTER INSERT ON revision WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'revision',
    json_object('change', 'stored', 'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.number,
      'state', new.state, 'held', json(iif(new.standing = 'held', 'true', 'false')), 'control', new.control,
      'author', new.author, 'comment', new.comment, 'sha256', lower(hex(new.sha256))));
END;

CREATE TRIGGER event_of_revision_state AFTER UPDATE OF state ON revision
WHEN new.state <> old.state AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'revision',
    json_object('change', 'state', 'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.number,
      'state', new.state, 'before', old.state, 'author', new.author, 'sha256', lower(hex(new.sha256))));
END;

CREATE TRIGGER event_of_new_run AFTER INSERT ON run WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'run',
    json_object('run', new.id, 'state', new.state, 'machine', (SELECT name FROM machine WHERE id = new.machine),
      'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'author', new.author,
      'job', new.job, 'executed', new.executed, 'reason', new.reason));
END;

CREATE TRIGGER event_of_run_state AFTER UPDATE OF state ON run
WHEN new.state <> old.state AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'run',
    json_object('run', new.id, 'state', new.state, 'machine', (SELECT name FROM machine WHERE id = new.machine),
      'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'author', new.author,
      'job', new.job, 'executed', new.executed, 'reason', new.reason));
END;

CREATE TRIGGER event_of_alarm AFTER INSERT ON record WHEN new.kind = 'alarm' AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'alarm',
    json_object('machine', (SELECT name FROM machine WHERE id = new.machine), 'run', new.run, 'line', new.line,
      'text', new.text, 'epoch', new.epoch, 'number', new.number));
END;

CREATE TRIGGER event_of_new_import AFTER INSERT ON import WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'import',
    json_object('program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'state', new.state,
      'machine', new.machine, 'class', new.class, 'who', new.who, 'reason', new.reason));
END;

CREATE TRIGGER event_of_import_state AFTER UPDATE OF state ON import
WHEN new.state <> old.state AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'import',
    json_object('program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'state', new.state,
      'machine', new.machine, 'class', new.class, 'who', new.who, 'reason', new.reason));
END;

CREATE TRIGGER event_of_new_job AFTER INSERT ON job WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
    json_object('change', 'added', 'job', new.id, 'machine', (SELECT name FROM machine WHERE id = new.machine),
      'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'quantity', new.quantity,
      'completed', 0));
END;

CREATE TRIGGER event_of_removed_job AFTER UPDATE OF removed_us ON job
WHEN new.removed_us IS NOT NULL AND old.removed_us IS NULL AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
    json_object('change', 'removed', 'job', new.id, 'machine', (SELECT name FROM machine WHERE id = new.machine),
      'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'quantity', new.quantity,
      'completed', new.parts_per_run * (SELECT count(*) FROM run WHERE run.job = new.id AND run.state = 'completed')));
END;

CREATE TRIGGER event_of_job_progress AFTER UPDATE OF state ON run
WHEN new.job IS NOT NULL AND new.state = 'completed' AND old.state <> 'completed' AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data)
    SELECT CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
      json_object('change', iif(parts.completed >= job.quantity, 'done', 'progress'), 'job', job.id,
        'machine', (SELECT name FROM machine WHERE id = job.machine), 'program', (SELECT name FROM program WHERE id = job.program),
        'revision', job.revision, 'quantity', job.quantity, 'completed', parts.completed)
    FROM job, (SELECT job.parts_per_run * count(*) AS completed FROM run JOIN job ON job.id = run.job
               WHERE run.job = new.job AND run.state = 'completed') AS parts
    WHERE job.id = new.job;
END;

CREATE TRIGGER event_of_job_hold AFTER INSERT ON job_hold WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
    json_object('change', 'held', 'machine', (SELECT name FROM machine WHERE id = new.machine), 'who', new.who, 'reason', new.reason));
END;

CREATE TRIGGER event_of_job_release AFTER DELETE ON job_hold WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
    json_object('change', 'released', 'machine', (SELECT name FROM machine WHERE id = old.machine)));
END;

-- Of a part that was measured: at once when it is outside its limits, otherwise when it is complete.
CREATE TRIGGER event_of_new_part AFTER INSERT ON measured_part
WHEN (new.verdict >= 2 OR new.ended_us IS NOT NULL) AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'part',
    json_object('part', new.id, 'machine', (SELECT name FROM machine WHERE id = new.machine), 'run', new.run,
      'program', new.program, 'number', new.number, 'serial', new.serial,
      'verdict', CASE new.verdict WHEN 0 THEN 'good' WHEN 1 THEN 'unknown' WHEN 2 THEN 'rework' ELSE 'scrap' END));
END;

CREATE TRIGGER event_of_verdict AFTER UPDATE OF verdict, ended_us ON measured_part
WHEN ((new.verdict >= 2 AND new.verdict <> old.verdict)
      OR (new.verdict < 2 AND new.ended_us IS NOT NULL AND old.ended_us IS NULL)) AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'part',
    json_object('part', new.id, 'machine', (SELECT name FROM machine WHERE id = new.machine), 'run', new.run,
      'program', new.program, 'number', new.number, 'serial', new.serial,
      'verdict', CASE new.verdict WHEN 0 THEN 'good' WHEN 1 THEN 'unknown' WHEN 2 THEN 'rework' ELSE 'scrap' END));
END;
