-- Version 3 in PostgreSQL: the few functions of SQLite that the repositories' SQL uses, and the views.

-- Of two values; with one argument they are PostgreSQL's own aggregates.
CREATE FUNCTION max(bigint, bigint) RETURNS bigint LANGUAGE sql IMMUTABLE
  AS 'SELECT CASE WHEN $1 IS NULL OR $2 IS NULL THEN NULL WHEN $1 < $2 THEN $2 ELSE $1 END';
CREATE FUNCTION min(bigint, bigint) RETURNS bigint LANGUAGE sql IMMUTABLE
  AS 'SELECT CASE WHEN $1 IS NULL OR $2 IS NULL THEN NULL WHEN $1 > $2 THEN $2 ELSE $1 END';
CREATE FUNCTION instr(text, text) RETURNS bigint LANGUAGE sql IMMUTABLE AS 'SELECT CAST(strpos($1, $2) AS bigint)';

-- In capital letters. The digest of a run in the audit trail is made of them: it must be the same in both engines.
CREATE FUNCTION hex(bytea) RETURNS text LANGUAGE sql IMMUTABLE AS $$SELECT upper(encode(coalesce($1, ''), 'hex'))$$;
-- Of the bytes that the text was made of (storage/postgresql/text_bytes.hpp).
CREATE FUNCTION hex(value text) RETURNS text LANGUAGE plpgsql IMMUTABLE AS $$
DECLARE
  digits text := '';
  letter text;
BEGIN
  IF value IS NULL THEN RETURN ''; END IF;
  IF value !~ U&'[\F700-\F7FF]' THEN RETURN upper(encode(convert_to(value, 'UTF8'), 'hex')); END IF;
  FOREACH letter IN ARRAY regexp_split_to_array(value, '') LOOP
    IF ascii(letter) BETWEEN 63232 AND 63487 THEN
      digits := digits || lpad(to_hex(ascii(letter) - 63232), 2, '0');
    ELSE
      digits := digits || encode(convert_to(letter, 'UTF8'), 'hex');
    END IF;
  END LOOP;
  RETURN upper(digits);
END $$;
CREATE FUNCTION quote(bigint) RETURNS text LANGUAGE sql IMMUTABLE AS $$SELECT coalesce(CAST($1 AS text), 'NULL')$$;
CREATE FUNCTION quote(bytea) RETURNS text LANGUAGE sql IMMUTABLE
  AS $$SELECT coalesce('X''' || upper(encode($1, 'hex')) || '''', 'NULL')$$;
CREATE FUNCTION join_next(text, text, text) RETURNS text LANGUAGE sql IMMUTABLE
  AS 'SELECT CASE WHEN $1 IS NULL THEN $2 ELSE $1 || $3 || $2 END';
CREATE AGGREGATE group_concat(text, text) (sfunc = join_next, stype = text);

-- Of each run its measured parts by verdict. Each template judges the same workpieces: good are those that all of them find good, not good those
-- that one of them does not.
CREATE VIEW run_verdicts AS SELECT run.id AS run, run.job, run.state,
  CAST((SELECT coalesce(min(parts), 0) FROM (
    SELECT sum(CASE WHEN verdict = 0 THEN parts ELSE 0 END) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id) AS counted
    GROUP BY template) AS by_template) AS bigint) AS good,
  CAST((SELECT coalesce(max(parts), 0) FROM (
    SELECT sum(CASE WHEN verdict = 0 THEN 0 ELSE parts END) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id) AS counted
    GROUP BY template) AS by_template) AS bigint) AS not_good,
  CAST((SELECT coalesce(max(parts), 0) FROM (
    SELECT sum(CASE WHEN verdict = 2 THEN parts ELSE 0 END) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id) AS counted
    GROUP BY template) AS by_template) AS bigint) AS rework,
  CAST((SELECT coalesce(max(parts), 0) FROM (
    SELECT sum(CASE WHEN verdict = 3 THEN parts ELSE 0 END) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id) AS counted
    GROUP BY template) AS by_template) AS bigint) AS scrap
FROM run;

-- How many parts of each job count up to its quantity. A run that reports more parts than it makes has as many fewer good ones as it reports others:
-- which of them is the workpiece is not known.
CREATE VIEW job_count AS SELECT job.id AS job,
  job.parts_per_run * (SELECT count(*) FROM run WHERE run.job = job.id AND run.state = 'completed') AS made,
  CAST((SELECT coalesce(sum(max(0, min(v.good, job.parts_per_run - v.not_good))), 0)
    FROM run_verdicts AS v WHERE v.job = job.id AND v.state = 'completed') AS bigint) AS good
FROM job;
