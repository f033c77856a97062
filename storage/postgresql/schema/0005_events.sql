-- Version 5 in PostgreSQL: events, written in the transaction of the change itself, and only while there is a webhook. Their data is what
-- SQLite's json_object gives, byte for byte.

CREATE FUNCTION add_event(of_kind text, of_data json) RETURNS void LANGUAGE sql AS $$
  INSERT INTO event (time_us, kind, data)
    VALUES (CAST(floor(extract(epoch FROM clock_timestamp()) * 1000) AS bigint) * 1000, of_kind, CAST(of_data AS text))
$$;
CREATE FUNCTION has_webhook() RETURNS boolean LANGUAGE sql STABLE AS 'SELECT EXISTS (SELECT 1 FROM webhook)';
CREATE FUNCTION machine_name(bigint) RETURNS text LANGUAGE sql STABLE AS 'SELECT name FROM machine WHERE id = $1';
CREATE FUNCTION program_name(bigint) RETURNS text LANGUAGE sql STABLE AS 'SELECT name FROM program WHERE id = $1';

CREATE FUNCTION event_of_new_revision() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('revision', row_to_json(d)) FROM (SELECT 'stored' AS change, program_name(NEW.program) AS program, NEW.number AS revision,
      NEW.state AS state, NEW.standing = 'held' AS held, NEW.control AS control, NEW.author AS author, NEW.comment AS comment,
      encode(NEW.sha256, 'hex') AS sha256) AS d;
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_new_revision AFTER INSERT ON revision FOR EACH ROW EXECUTE FUNCTION event_of_new_revision();

CREATE FUNCTION event_of_revision_state() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('revision', row_to_json(d)) FROM (SELECT 'state' AS change, program_name(NEW.program) AS program, NEW.number AS revision,
      NEW.state AS state, OLD.state AS before, NEW.author AS author, encode(NEW.sha256, 'hex') AS sha256) AS d;
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_revision_state AFTER UPDATE OF state ON revision FOR EACH ROW WHEN (NEW.state <> OLD.state)
  EXECUTE FUNCTION event_of_revision_state();

CREATE FUNCTION event_of_run() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('run', row_to_json(d)) FROM (SELECT NEW.id AS run, NEW.state AS state, machine_name(NEW.machine) AS machine,
      program_name(NEW.program) AS program, NEW.revision AS revision, NEW.author AS author, NEW.job AS job, NEW.executed AS executed,
      NEW.reason AS reason) AS d;
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_new_run AFTER INSERT ON run FOR EACH ROW EXECUTE FUNCTION event_of_run();
CREATE TRIGGER event_of_run_state AFTER UPDATE OF state ON run FOR EACH ROW WHEN (NEW.state <> OLD.state) EXECUTE FUNCTION event_of_run();

CREATE FUNCTION event_of_alarm() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('alarm', row_to_json(d)) FROM (SELECT machine_name(NEW.machine) AS machine, NEW.run AS run, NEW.line AS line,
      NEW.text AS text, NEW.epoch AS epoch, NEW.number AS number) AS d;
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_alarm AFTER INSERT ON record FOR EACH ROW WHEN (NEW.kind = 'alarm') EXECUTE FUNCTION event_of_alarm();

CREATE FUNCTION event_of_import() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('import', row_to_json(d)) FROM (SELECT program_name(NEW.program) AS program, NEW.revision AS revision, NEW.state AS state,
      NEW.machine AS machine, NEW.class AS class, NEW.who AS who, NEW.reason AS reason) AS d;
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_new_import AFTER INSERT ON import FOR EACH ROW EXECUTE FUNCTION event_of_import();
CREATE TRIGGER event_of_import_state AFTER UPDATE OF state ON import FOR EACH ROW WHEN (NEW.state <> OLD.state)
  EXECUTE FUNCTION event_of_import();

CREATE FUNCTION event_of_new_job() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('job', row_to_json(d)) FROM (SELECT 'added' AS change, NEW.id AS job, machine_name(NEW.machine) AS machine,
      program_name(NEW.program) AS program, NEW.revision AS revision, NEW.quantity AS quantity, 0 AS completed) AS d;
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_new_job AFTER INSERT ON job FOR EACH ROW EXECUTE FUNCTION event_of_new_job();

CREATE FUNCTION event_of_removed_job() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('job', row_to_json(d)) FROM (SELECT 'removed' AS change, NEW.id AS job, machine_name(NEW.machine) AS machine,
      program_name(NEW.program) AS program, NEW.revision AS revision, NEW.quantity AS quantity,
      NEW.parts_per_run * (SELECT count(*) FROM run WHERE run.job = NEW.id AND run.state = 'completed') AS completed) AS d;
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_removed_job AFTER UPDATE OF removed_us ON job FOR EACH ROW
  WHEN (NEW.removed_us IS NOT NULL AND OLD.removed_us IS NULL) EXECUTE FUNCTION event_of_removed_job();

CREATE FUNCTION add_job_progress(of_job bigint) RETURNS void LANGUAGE sql AS $$
  SELECT add_event('job', row_to_json(d)) FROM (
    SELECT CASE WHEN CASE WHEN job.counts = 'good' THEN c.good ELSE c.made END >= job.quantity THEN 'done' ELSE 'progress' END AS change,
      job.id AS job, machine_name(job.machine) AS machine, program_name(job.program) AS program, job.revision AS revision,
      job.quantity AS quantity, c.made AS completed, job.counts AS counts, c.good AS good
    FROM job JOIN job_count AS c ON c.job = job.id WHERE job.id = of_job) AS d
$$;

CREATE FUNCTION event_of_job_progress() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF has_webhook() THEN PERFORM add_job_progress(NEW.job); END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_job_progress AFTER UPDATE OF state ON run FOR EACH ROW
  WHEN (NEW.job IS NOT NULL AND NEW.state = 'completed' AND OLD.state <> 'completed') EXECUTE FUNCTION event_of_job_progress();

CREATE FUNCTION event_of_job_hold() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF NOT has_webhook() THEN RETURN NULL; END IF;
  IF TG_OP = 'DELETE' THEN
    PERFORM add_event('job', row_to_json(d)) FROM (SELECT 'released' AS change, machine_name(OLD.machine) AS machine) AS d;
  ELSE
    PERFORM add_event('job', row_to_json(d))
      FROM (SELECT 'held' AS change, machine_name(NEW.machine) AS machine, NEW.who AS who, NEW.reason AS reason) AS d;
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_job_hold AFTER INSERT OR DELETE ON job_hold FOR EACH ROW EXECUTE FUNCTION event_of_job_hold();

-- Of a part that was measured: at once when it is outside its limits, otherwise when it is complete.
CREATE FUNCTION event_of_part() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('part', row_to_json(d)) FROM (SELECT NEW.id AS part, machine_name(NEW.machine) AS machine, NEW.run AS run,
      NEW.program AS program, NEW.number AS number, NEW.serial AS serial,
      CASE NEW.verdict WHEN 0 THEN 'good' WHEN 1 THEN 'unknown' WHEN 2 THEN 'rework' ELSE 'scrap' END AS verdict) AS d;
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_new_part AFTER INSERT ON measured_part FOR EACH ROW WHEN (NEW.verdict >= 2 OR NEW.ended_us IS NOT NULL)
  EXECUTE FUNCTION event_of_part();
CREATE TRIGGER event_of_verdict AFTER UPDATE OF verdict, ended_us ON measured_part FOR EACH ROW
  WHEN ((NEW.verdict >= 2 AND NEW.verdict <> OLD.verdict) OR (NEW.verdict < 2 AND NEW.ended_us IS NOT NULL AND OLD.ended_us IS NULL))
  EXECUTE FUNCTION event_of_part();

-- The verdict on a part comes after the end of its run.
CREATE FUNCTION event_of_good_part() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_job_progress(run.job) FROM run JOIN job ON job.id = run.job
      WHERE run.id = NEW.run AND run.state = 'completed' AND job.counts = 'good';
  END IF;
  RETURN NULL;
END $$;
CREATE TRIGGER event_of_new_good_part AFTER INSERT ON measured_part FOR EACH ROW
  WHEN (NEW.verdict = 0 AND NEW.ended_us IS NOT NULL AND NEW.run IS NOT NULL) EXECUTE FUNCTION event_of_good_part();
CREATE TRIGGER event_of_good_part AFTER UPDATE OF verdict, ended_us ON measured_part FOR EACH ROW
  WHEN (NEW.verdict = 0 AND NEW.ended_us IS NOT NULL AND OLD.ended_us IS NULL AND NEW.run IS NOT NULL) EXECUTE FUNCTION event_of_good_part();
