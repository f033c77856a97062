-- Version 17: how many parts archives took, what a job counts, why machines are held.

-- Of each run the parts whose rows went into an archive, by template and verdict; without superseded ones and those of no run.
-- Counted in the transaction that takes a part out of its table.
CREATE TABLE archived_part (
  run      TEXT NOT NULL,
  archive  INTEGER NOT NULL REFERENCES archive (id),
  template TEXT NOT NULL,
  verdict  INTEGER NOT NULL CHECK (verdict BETWEEN 0 AND 3),  -- as measured_part.verdict
  parts    INTEGER NOT NULL CHECK (parts > 0),
  PRIMARY KEY (run, archive, template, verdict)
) STRICT, WITHOUT ROWID;

-- 0: parts left for it before they were counted, so nobody knows of which runs they were without reading the file.
ALTER TABLE archive ADD COLUMN is_counted INTEGER NOT NULL DEFAULT 1 CHECK (is_counted IN (0, 1));
UPDATE archive SET is_counted = 0 WHERE kind = 'measurements';

-- What is counted up to the quantity: the parts of completed runs, or of those the ones that were measured good.
ALTER TABLE job ADD COLUMN counts TEXT NOT NULL DEFAULT 'made' CHECK (counts IN ('made', 'good'));

-- Of each run its measured parts by verdict. Each template judges the same workpieces: good are those that all of them find good.
CREATE VIEW run_verdicts AS SELECT run.id AS run, run.job, run.state,
  (SELECT coalesce(min(parts), 0) FROM (
    SELECT sum(iif(verdict = 0, parts, 0)) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id)
    GROUP BY template)) AS good,
  (SELECT coalesce(max(parts), 0) FROM (
    SELECT sum(iif(verdict = 2, parts, 0)) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id)
    GROUP BY template)) AS rework,
  (SELECT coalesce(max(parts), 0) FROM (
    SELECT sum(iif(verdict = 3, parts, 0)) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id)
    GROUP BY template)) AS scrap
FROM run;

-- How many parts of each job count up to its quantity.
CREATE VIEW job_count AS SELECT job.id AS job,
  job.parts_per_run * (SELECT count(*) FROM run WHERE run.job = job.id AND run.state = 'completed') AS made,
  (SELECT coalesce(sum(min(v.good, job.parts_per_run)), 0) FROM run_verdicts AS v WHERE v.job = job.id AND v.state = 'completed') AS good
FROM job;

DROP TRIGGER event_of_job_progress;
CREATE TRIGGER event_of_job_progress AFTER UPDATE OF state ON run
WHEN new.job IS NOT NULL AND new.state = 'completed' AND old.state <> 'completed' AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data)
    SELECT CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
      json_object('change', iif(iif(job.counts = 'good', c.good, c.made) >= job.quantity, 'done', 'progress'), 'job', job.id,
        'machine', (SELECT name FROM machine WHERE id = job.machine), 'program', (SELECT name FROM program WHERE id = job.program),
        'revision', job.revision, 'quantity', job.quantity, 'completed', c.made, 'counts', job.counts, 'good', c.good)
    FROM job JOIN job_count AS c ON c.job = job.id WHERE job.id = new.job;
END;

-- The verdict on a part comes after the end of its run.
CREATE TRIGGER event_of_new_good_part AFTER INSERT ON measured_part
WHEN new.verdict = 0 AND new.ended_us IS NOT NULL AND new.run IS NOT NULL AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data)
    SELECT CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
      json_object('change', iif(c.good >= job.quantity, 'done', 'progress'), 'job', job.id,
        'machine', (SELECT name FROM machine WHERE id = job.machine), 'program', (SELECT name FROM program WHERE id = job.program),
        'revision', job.revision, 'quantity', job.quantity, 'completed', c.made, 'counts', job.counts, 'good', c.good)
    FROM run JOIN job ON job.id = run.job JOIN job_count AS c ON c.job = job.id
    WHERE run.id = new.run AND run.state = 'completed' AND job.counts = 'good';
END;

CREATE TRIGGER event_of_good_part AFTER UPDATE OF verdict, ended_us ON measured_part
WHEN new.verdict = 0 AND new.ended_us IS NOT NULL AND old.ended_us IS NULL AND new.run IS NOT NULL AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data)
    SELECT CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
      json_object('change', iif(c.good >= job.quantity, 'done', 'progress'), 'job', job.id,
        'machine', (SELECT name FROM machine WHERE id = job.machine), 'program', (SELECT name FROM program WHERE id = job.program),
        'revision', job.revision, 'quantity', job.quantity, 'completed', c.made, 'counts', job.counts, 'good', c.good)
    FROM run JOIN job ON job.id = run.job JOIN job_count AS c ON c.job = job.id
    WHERE run.id = new.run AND run.state = 'completed' AND job.counts = 'good';
END;

-- Who holds the motion of a machine, and why, until it continues.
CREATE TABLE machine_hold (
  machine  INTEGER PRIMARY KEY REFERENCES machine (id),
  run      TEXT NOT NULL,  -- its id; empty: of no run
  who      TEXT NOT NULL,
  reason   TEXT NOT NULL,  -- empty: none was given
  since_us INTEGER NOT NULL
) STRICT;
