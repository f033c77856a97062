-- Version 18: which setup is in a control that gets none with a start, and what counts as good of a run that reports more parts than it makes.

-- By the word of who loaded it at the control; the audit trail has the words before.
CREATE TABLE loaded_setup (
  machine   TEXT PRIMARY KEY,  -- not a reference, as in setup
  number    INTEGER,           -- NULL: not known
  who       TEXT NOT NULL,
  loaded_us INTEGER NOT NULL,
  FOREIGN KEY (machine, number) REFERENCES setup (machine, number)
) STRICT, WITHOUT ROWID;

DROP VIEW job_count;
DROP VIEW run_verdicts;

-- Of each run its measured parts by verdict. Each template judges the same workpieces: good are those that all of them find good, not good those
-- that one of them does not.
CREATE VIEW run_verdicts AS SELECT run.id AS run, run.job, run.state,
  (SELECT coalesce(min(parts), 0) FROM (
    SELECT sum(iif(verdict = 0, parts, 0)) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id)
    GROUP BY template)) AS good,
  (SELECT coalesce(max(parts), 0) FROM (
    SELECT sum(iif(verdict = 0, 0, parts)) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id)
    GROUP BY template)) AS not_good,
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

-- How many parts of each job count up to its quantity. A run that reports more parts than it makes has as many fewer good ones as it reports others:
-- which of them is the workpiece is not known.
CREATE VIEW job_count AS SELECT job.id AS job,
  job.parts_per_run * (SELECT count(*) FROM run WHERE run.job = job.id AND run.state = 'completed') AS made,
  (SELECT coalesce(sum(max(0, min(v.good, job.parts_per_run - v.not_good))), 0)
    FROM run_verdicts AS v WHERE v.job = job.id AND v.state = 'completed') AS good
FROM job;
