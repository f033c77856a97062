-- A PostgreSQL database of schema version 13 with a bit of everything, as the program of that version left it.
--
-- PostgreSQL database dump
--



SET statement_timeout = 0;
SET lock_timeout = 0;
SET idle_in_transaction_session_timeout = 0;
SET client_encoding = 'UTF8';
SET standard_conforming_strings = on;
SET check_function_bodies = false;
SET xmloption = content;
SET client_min_messages = warning;
SET row_security = off;

--
-- Name: add_event(text, json); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.add_event(of_kind text, of_data json) RETURNS void
    LANGUAGE sql
    AS $$
  INSERT INTO event (time_us, kind, data)
    VALUES (CAST(floor(extract(epoch FROM clock_timestamp()) * 1000) AS bigint) * 1000, of_kind, CAST(of_data AS text))
$$;


--
-- Name: add_job_progress(bigint); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.add_job_progress(of_job bigint) RETURNS void
    LANGUAGE sql
    AS $$
  SELECT add_event('job', row_to_json(d)) FROM (
    SELECT CASE WHEN CASE WHEN job.counts = 'good' THEN c.good ELSE c.made END >= job.quantity THEN 'done' ELSE 'progress' END AS change,
      job.id AS job, machine_name(job.machine) AS machine, program_name(job.program) AS program, job.revision AS revision,
      job.quantity AS quantity, c.made AS completed, job.counts AS counts, c.good AS good
    FROM job JOIN job_count AS c ON c.job = job.id WHERE job.id = of_job) AS d
$$;


--
-- Name: event_of_alarm(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_alarm() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('alarm', row_to_json(d)) FROM (SELECT machine_name(NEW.machine) AS machine, NEW.run AS run, NEW.line AS line,
      NEW.text AS text, NEW.epoch AS epoch, NEW.number AS number) AS d;
  END IF;
  RETURN NULL;
END $$;


--
-- Name: event_of_good_part(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_good_part() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_job_progress(run.job) FROM run JOIN job ON job.id = run.job
      WHERE run.id = NEW.run AND run.state = 'completed' AND job.counts = 'good';
  END IF;
  RETURN NULL;
END $$;


--
-- Name: event_of_import(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_import() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('import', row_to_json(d)) FROM (SELECT program_name(NEW.program) AS program, NEW.revision AS revision, NEW.state AS state,
      NEW.machine AS machine, NEW.class AS class, NEW.who AS who, NEW.reason AS reason) AS d;
  END IF;
  RETURN NULL;
END $$;


--
-- Name: event_of_job_hold(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_job_hold() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
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


--
-- Name: event_of_job_progress(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_job_progress() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  IF has_webhook() THEN PERFORM add_job_progress(NEW.job); END IF;
  RETURN NULL;
END $$;


--
-- Name: event_of_new_job(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_new_job() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('job', row_to_json(d)) FROM (SELECT 'added' AS change, NEW.id AS job, machine_name(NEW.machine) AS machine,
      program_name(NEW.program) AS program, NEW.revision AS revision, NEW.quantity AS quantity, 0 AS completed) AS d;
  END IF;
  RETURN NULL;
END $$;


--
-- Name: event_of_new_revision(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_new_revision() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('revision', row_to_json(d)) FROM (SELECT 'stored' AS change, program_name(NEW.program) AS program, NEW.number AS revision,
      NEW.state AS state, NEW.standing = 'held' AS held, NEW.control AS control, NEW.author AS author, NEW.comment AS comment,
      encode(NEW.sha256, 'hex') AS sha256) AS d;
  END IF;
  RETURN NULL;
END $$;


--
-- Name: event_of_part(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_part() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('part', row_to_json(d)) FROM (SELECT NEW.id AS part, machine_name(NEW.machine) AS machine, NEW.run AS run,
      NEW.program AS program, NEW.number AS number, NEW.serial AS serial,
      CASE NEW.verdict WHEN 0 THEN 'good' WHEN 1 THEN 'unknown' WHEN 2 THEN 'rework' ELSE 'scrap' END AS verdict) AS d;
  END IF;
  RETURN NULL;
END $$;


--
-- Name: event_of_removed_job(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_removed_job() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('job', row_to_json(d)) FROM (SELECT 'removed' AS change, NEW.id AS job, machine_name(NEW.machine) AS machine,
      program_name(NEW.program) AS program, NEW.revision AS revision, NEW.quantity AS quantity,
      NEW.parts_per_run * (SELECT count(*) FROM run WHERE run.job = NEW.id AND run.state = 'completed') AS completed) AS d;
  END IF;
  RETURN NULL;
END $$;


--
-- Name: event_of_revision_state(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_revision_state() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('revision', row_to_json(d)) FROM (SELECT 'state' AS change, program_name(NEW.program) AS program, NEW.number AS revision,
      NEW.state AS state, OLD.state AS before, NEW.author AS author, encode(NEW.sha256, 'hex') AS sha256) AS d;
  END IF;
  RETURN NULL;
END $$;


--
-- Name: event_of_run(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.event_of_run() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  IF has_webhook() THEN
    PERFORM add_event('run', row_to_json(d)) FROM (SELECT NEW.id AS run, NEW.state AS state, machine_name(NEW.machine) AS machine,
      program_name(NEW.program) AS program, NEW.revision AS revision, NEW.author AS author, NEW.job AS job, NEW.executed AS executed,
      NEW.reason AS reason) AS d;
  END IF;
  RETURN NULL;
END $$;


--
-- Name: has_webhook(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.has_webhook() RETURNS boolean
    LANGUAGE sql STABLE
    AS $$SELECT EXISTS (SELECT 1 FROM webhook)$$;


--
-- Name: hex(bytea); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.hex(bytea) RETURNS text
    LANGUAGE sql IMMUTABLE
    AS $_$SELECT upper(encode(coalesce($1, ''), 'hex'))$_$;


--
-- Name: hex(text); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.hex(value text) RETURNS text
    LANGUAGE plpgsql IMMUTABLE
    AS $$
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


--
-- Name: instr(text, text); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.instr(text, text) RETURNS bigint
    LANGUAGE sql IMMUTABLE
    AS $_$SELECT CAST(strpos($1, $2) AS bigint)$_$;


--
-- Name: join_next(text, text, text); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.join_next(text, text, text) RETURNS text
    LANGUAGE sql IMMUTABLE
    AS $_$SELECT CASE WHEN $1 IS NULL THEN $2 ELSE $1 || $3 || $2 END$_$;


--
-- Name: list_again(bigint); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.list_again(changed bigint) RETURNS void
    LANGUAGE plpgsql
    AS $$
BEGIN
  UPDATE program SET (revisions, held, released, latest) = (
    SELECT count(*), count(*) FILTER (WHERE standing = 'held'), max(number) FILTER (WHERE state = 'released'),
           coalesce(max(number) FILTER (WHERE standing = 'accepted'), max(number))
    FROM revision WHERE revision.program = program.id AND number > removed_through AND standing <> 'rejected')
    WHERE id = changed;
  UPDATE program SET (latest_control, latest_author, latest_state) = (
    SELECT control, author, state FROM revision WHERE revision.program = program.id AND number = latest)
    WHERE id = changed;
  PERFORM note_due(changed);
END $$;


--
-- Name: machine_name(bigint); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.machine_name(bigint) RETURNS text
    LANGUAGE sql STABLE
    AS $_$SELECT name FROM machine WHERE id = $1$_$;


--
-- Name: max(bigint, bigint); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.max(bigint, bigint) RETURNS bigint
    LANGUAGE sql IMMUTABLE
    AS $_$SELECT CASE WHEN $1 IS NULL OR $2 IS NULL THEN NULL WHEN $1 < $2 THEN $2 ELSE $1 END$_$;


--
-- Name: min(bigint, bigint); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.min(bigint, bigint) RETURNS bigint
    LANGUAGE sql IMMUTABLE
    AS $_$SELECT CASE WHEN $1 IS NULL OR $2 IS NULL THEN NULL WHEN $1 > $2 THEN $2 ELSE $1 END$_$;


--
-- Name: note_due(bigint); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.note_due(bigint) RETURNS void
    LANGUAGE sql
    AS $_$INSERT INTO search_due (program) VALUES ($1) ON CONFLICT (program) DO UPDATE SET version = search_due.version + 1$_$;


--
-- Name: on_attachment(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.on_attachment() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  PERFORM note_due(CASE TG_OP WHEN 'DELETE' THEN OLD.program ELSE NEW.program END);
  RETURN NULL;
END $$;


--
-- Name: on_program_described(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.on_program_described() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  PERFORM note_due(NEW.id);
  RETURN NULL;
END $$;


--
-- Name: on_program_removed(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.on_program_removed() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  -- A program that is pushed again under the name begins without them.
  UPDATE program SET part = '', operation = '', material = '', machine_group = '' WHERE id = NEW.id;
  UPDATE attachment SET revision = NEW.removed_through WHERE program = NEW.id AND revision IS NULL AND NOT EXISTS (
    SELECT 1 FROM attachment AS other WHERE other.program = NEW.id AND other.revision = NEW.removed_through AND other.name = attachment.name);
  DELETE FROM attachment WHERE program = NEW.id AND revision IS NULL;
  PERFORM list_again(NEW.id);
  RETURN NULL;
END $$;


--
-- Name: on_revision(); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.on_revision() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN
  PERFORM list_again(NEW.program);
  RETURN NULL;
END $$;


--
-- Name: program_name(bigint); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.program_name(bigint) RETURNS text
    LANGUAGE sql STABLE
    AS $_$SELECT name FROM program WHERE id = $1$_$;


--
-- Name: quote(bytea); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.quote(bytea) RETURNS text
    LANGUAGE sql IMMUTABLE
    AS $_$SELECT coalesce('X''' || upper(encode($1, 'hex')) || '''', 'NULL')$_$;


--
-- Name: quote(bigint); Type: FUNCTION; Schema: public; Owner: -
--

CREATE FUNCTION public.quote(bigint) RETURNS text
    LANGUAGE sql IMMUTABLE
    AS $_$SELECT coalesce(CAST($1 AS text), 'NULL')$_$;


--
-- Name: group_concat(text, text); Type: AGGREGATE; Schema: public; Owner: -
--

CREATE AGGREGATE public.group_concat(text, text) (
    SFUNC = public.join_next,
    STYPE = text
);


SET default_tablespace = '';

SET default_table_access_method = heap;

--
-- Name: archive; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.archive (
    id bigint NOT NULL,
    kind text NOT NULL COLLATE pg_catalog."C",
    machine text NOT NULL COLLATE pg_catalog."C",
    epoch bigint NOT NULL,
    first bigint NOT NULL,
    last bigint NOT NULL,
    is_removed bigint DEFAULT 0 NOT NULL,
    file text NOT NULL COLLATE pg_catalog."C",
    sha256 bytea NOT NULL,
    rows bigint NOT NULL,
    bytes bigint NOT NULL,
    first_us bigint NOT NULL,
    last_us bigint NOT NULL,
    created_us bigint NOT NULL,
    is_counted bigint DEFAULT 1 NOT NULL,
    CONSTRAINT archive_is_counted_check CHECK ((is_counted = ANY (ARRAY[(0)::bigint, (1)::bigint]))),
    CONSTRAINT archive_is_removed_check CHECK ((is_removed = ANY (ARRAY[(0)::bigint, (1)::bigint]))),
    CONSTRAINT archive_kind_check CHECK ((kind = ANY (ARRAY['records'::text, 'measurements'::text]))),
    CONSTRAINT archive_sha256_check CHECK ((length(sha256) = 32))
);


--
-- Name: archive_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.archive ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.archive_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: archived_part; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.archived_part (
    run text NOT NULL COLLATE pg_catalog."C",
    archive bigint NOT NULL,
    template text NOT NULL COLLATE pg_catalog."C",
    verdict bigint NOT NULL,
    parts bigint NOT NULL,
    CONSTRAINT archived_part_parts_check CHECK ((parts > 0)),
    CONSTRAINT archived_part_verdict_check CHECK (((verdict >= 0) AND (verdict <= 3)))
);


--
-- Name: attachment; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.attachment (
    id bigint NOT NULL,
    program bigint NOT NULL,
    revision bigint,
    name text NOT NULL COLLATE pg_catalog."C",
    content bigint NOT NULL,
    sha256 bytea NOT NULL,
    comment text NOT NULL COLLATE pg_catalog."C",
    author text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    CONSTRAINT attachment_sha256_check CHECK ((length(sha256) = 32))
);


--
-- Name: attachment_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.attachment ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.attachment_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: audit; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.audit (
    id bigint NOT NULL,
    time_us bigint NOT NULL,
    who text NOT NULL COLLATE pg_catalog."C",
    action text NOT NULL COLLATE pg_catalog."C",
    subject text NOT NULL COLLATE pg_catalog."C",
    detail text NOT NULL COLLATE pg_catalog."C",
    credential text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    address text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    chain bytea,
    CONSTRAINT audit_chain_check CHECK ((length(chain) = 32))
);


--
-- Name: audit_checkpoint; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.audit_checkpoint (
    number bigint NOT NULL,
    entry bigint NOT NULL,
    time_us bigint NOT NULL,
    chain bytea NOT NULL,
    signature bytea NOT NULL,
    CONSTRAINT audit_checkpoint_chain_check CHECK ((length(chain) = 32)),
    CONSTRAINT audit_checkpoint_signature_check CHECK ((length(signature) = 64))
);


--
-- Name: characteristic; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.characteristic (
    id bigint NOT NULL,
    name bigint NOT NULL,
    nominal double precision,
    lower double precision,
    upper double precision,
    unit text NOT NULL COLLATE pg_catalog."C",
    decimals bigint NOT NULL,
    tool text NOT NULL COLLATE pg_catalog."C"
);


--
-- Name: characteristic_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.characteristic ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.characteristic_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: characteristic_name; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.characteristic_name (
    id bigint NOT NULL,
    name text NOT NULL COLLATE pg_catalog."C"
);


--
-- Name: characteristic_name_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.characteristic_name ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.characteristic_name_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: chunk; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.chunk (
    id bigint NOT NULL,
    sha256 bytea NOT NULL,
    size bigint NOT NULL,
    data bytea NOT NULL,
    CONSTRAINT chunk_sha256_check CHECK ((length(sha256) = 32)),
    CONSTRAINT chunk_size_check CHECK (((size >= 1) AND (size <= 262144)))
);
ALTER TABLE ONLY public.chunk ALTER COLUMN data SET STORAGE EXTERNAL;


--
-- Name: chunk_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.chunk ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.chunk_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: content; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.content (
    id bigint NOT NULL,
    sha256 bytea,
    size bigint NOT NULL,
    seal bytea,
    CONSTRAINT content_seal_check CHECK ((length(seal) = 32)),
    CONSTRAINT content_sha256_check CHECK ((length(sha256) = 32)),
    CONSTRAINT content_size_check CHECK ((size >= 0))
);


--
-- Name: content_chunk; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.content_chunk (
    content bigint NOT NULL,
    "position" bigint NOT NULL,
    chunk bigint NOT NULL,
    sha256 bytea,
    CONSTRAINT content_chunk_position_check CHECK (("position" >= 0)),
    CONSTRAINT content_chunk_sha256_check CHECK ((length(sha256) = 32))
);


--
-- Name: content_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.content ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.content_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: credential; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.credential (
    "user" text NOT NULL COLLATE pg_catalog."C",
    name text NOT NULL COLLATE pg_catalog."C",
    kind text NOT NULL COLLATE pg_catalog."C",
    sha256 bytea NOT NULL,
    role text NOT NULL COLLATE pg_catalog."C",
    has_groups bigint NOT NULL,
    created_us bigint NOT NULL,
    expires_us bigint,
    used_us bigint,
    used_from text NOT NULL COLLATE pg_catalog."C",
    CONSTRAINT credential_has_groups_check CHECK ((has_groups = ANY (ARRAY[(0)::bigint, (1)::bigint]))),
    CONSTRAINT credential_kind_check CHECK ((kind = ANY (ARRAY['token'::text, 'login'::text, 'page'::text]))),
    CONSTRAINT credential_role_check CHECK ((role = ANY (ARRAY['viewer'::text, 'operator'::text, 'programmer'::text, 'approver'::text, 'administrator'::text]))),
    CONSTRAINT credential_sha256_check CHECK ((length(sha256) = 32))
);


--
-- Name: credential_group; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.credential_group (
    "user" text NOT NULL COLLATE pg_catalog."C",
    name text NOT NULL COLLATE pg_catalog."C",
    machine_group text NOT NULL COLLATE pg_catalog."C"
);


--
-- Name: event; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.event (
    id bigint NOT NULL,
    time_us bigint NOT NULL,
    kind text NOT NULL COLLATE pg_catalog."C",
    data text NOT NULL COLLATE pg_catalog."C"
);


--
-- Name: event_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.event ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.event_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: folder_file; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.folder_file (
    id bigint NOT NULL,
    folder text NOT NULL COLLATE pg_catalog."C",
    name text NOT NULL COLLATE pg_catalog."C",
    sha256 bytea NOT NULL,
    size bigint NOT NULL,
    changed_ns bigint NOT NULL,
    state text NOT NULL COLLATE pg_catalog."C",
    program text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    revision bigint,
    reason text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    target text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    taken_us bigint NOT NULL,
    moved_us bigint,
    CONSTRAINT folder_file_sha256_check CHECK ((length(sha256) = 32)),
    CONSTRAINT folder_file_size_check CHECK ((size >= 0)),
    CONSTRAINT folder_file_state_check CHECK ((state = ANY (ARRAY['taken'::text, 'stored'::text, 'failed'::text])))
);


--
-- Name: folder_file_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.folder_file ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.folder_file_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: identity; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.identity (
    id text NOT NULL COLLATE pg_catalog."C"
);


--
-- Name: import; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.import (
    program bigint NOT NULL,
    revision bigint NOT NULL,
    machine text NOT NULL COLLATE pg_catalog."C",
    state text DEFAULT 'pending'::text NOT NULL COLLATE pg_catalog."C",
    base bigint,
    class text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    fault text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    compared_us bigint,
    decided_us bigint,
    who text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    reason text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    is_at_once bigint DEFAULT 0 NOT NULL,
    target text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    target_revision bigint,
    CONSTRAINT import_is_at_once_check CHECK ((is_at_once = ANY (ARRAY[(0)::bigint, (1)::bigint]))),
    CONSTRAINT import_state_check CHECK ((state = ANY (ARRAY['pending'::text, 'accepted'::text, 'accepted_as'::text, 'rejected'::text])))
);


--
-- Name: job; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.job (
    id bigint NOT NULL,
    machine bigint NOT NULL,
    "position" bigint NOT NULL,
    program bigint NOT NULL,
    revision bigint,
    quantity bigint NOT NULL,
    parts_per_run bigint NOT NULL,
    comment text NOT NULL COLLATE pg_catalog."C",
    author text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    removed_us bigint,
    counts text DEFAULT 'made'::text NOT NULL COLLATE pg_catalog."C",
    CONSTRAINT job_counts_check CHECK ((counts = ANY (ARRAY['made'::text, 'good'::text]))),
    CONSTRAINT job_parts_per_run_check CHECK ((parts_per_run >= 1)),
    CONSTRAINT job_quantity_check CHECK ((quantity >= 1))
);


--
-- Name: measured_part; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.measured_part (
    id bigint NOT NULL,
    machine bigint NOT NULL,
    run text COLLATE pg_catalog."C",
    program text NOT NULL COLLATE pg_catalog."C",
    revision bigint NOT NULL,
    template text NOT NULL COLLATE pg_catalog."C",
    version bigint NOT NULL,
    number text NOT NULL COLLATE pg_catalog."C",
    serial text NOT NULL COLLATE pg_catalog."C",
    measurements bigint NOT NULL,
    findings bigint NOT NULL,
    verdict bigint NOT NULL,
    begun_us bigint NOT NULL,
    ended_us bigint,
    is_superseded bigint DEFAULT 0 NOT NULL,
    CONSTRAINT measured_part_is_superseded_check CHECK ((is_superseded = ANY (ARRAY[(0)::bigint, (1)::bigint]))),
    CONSTRAINT measured_part_verdict_check CHECK (((verdict >= 0) AND (verdict <= 3)))
);


--
-- Name: run; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.run (
    number bigint NOT NULL,
    id text NOT NULL COLLATE pg_catalog."C",
    machine bigint NOT NULL,
    program bigint NOT NULL,
    revision bigint NOT NULL,
    control text NOT NULL COLLATE pg_catalog."C",
    state text NOT NULL COLLATE pg_catalog."C",
    sent bigint NOT NULL,
    accepted bigint NOT NULL,
    executed bigint NOT NULL,
    line bigint NOT NULL,
    sequence bigint NOT NULL,
    reason text NOT NULL COLLATE pg_catalog."C",
    executed_content text COLLATE pg_catalog."C",
    content_verified bigint,
    author text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    started_us bigint,
    ended_us bigint,
    outputs bigint DEFAULT 0 NOT NULL,
    setup bigint,
    sha256 bytea,
    allowed_as text DEFAULT 'open'::text NOT NULL COLLATE pg_catalog."C",
    approval bigint,
    job bigint,
    gateway_setup text COLLATE pg_catalog."C",
    motion_seconds double precision,
    path_mm double precision,
    is_test bigint DEFAULT 0 NOT NULL,
    CONSTRAINT run_allowed_as_check CHECK ((allowed_as = ANY (ARRAY['open'::text, 'released'::text, 'prove_out'::text]))),
    CONSTRAINT run_content_verified_check CHECK ((content_verified = ANY (ARRAY[(0)::bigint, (1)::bigint]))),
    CONSTRAINT run_is_test_check CHECK ((is_test = ANY (ARRAY[(0)::bigint, (1)::bigint]))),
    CONSTRAINT run_motion_seconds_check CHECK ((motion_seconds >= (0)::double precision)),
    CONSTRAINT run_path_mm_check CHECK ((path_mm >= (0)::double precision)),
    CONSTRAINT run_sha256_check CHECK ((length(sha256) = 32)),
    CONSTRAINT run_state_check CHECK ((state = ANY (ARRAY['ordered'::text, 'active'::text, 'completed'::text, 'aborted'::text, 'alarmed'::text, 'interrupted'::text, 'refused'::text, 'tested'::text])))
);


--
-- Name: run_verdicts; Type: VIEW; Schema: public; Owner: -
--

CREATE VIEW public.run_verdicts AS
 SELECT run.id AS run,
    run.job,
    run.state,
    (( SELECT COALESCE(min(by_template.parts), (0)::numeric) AS "coalesce"
           FROM ( SELECT sum(
                        CASE
                            WHEN (counted.verdict = 0) THEN counted.parts
                            ELSE (0)::bigint
                        END) AS parts
                   FROM ( SELECT measured_part.template,
                            measured_part.verdict,
                            1 AS parts
                           FROM public.measured_part
                          WHERE ((measured_part.run = run.id) AND (measured_part.is_superseded = 0) AND (measured_part.ended_us IS NOT NULL))
                        UNION ALL
                         SELECT archived_part.template,
                            archived_part.verdict,
                            archived_part.parts
                           FROM public.archived_part
                          WHERE (archived_part.run = run.id)) counted
                  GROUP BY counted.template) by_template))::bigint AS good,
    (( SELECT COALESCE(max(by_template.parts), (0)::numeric) AS "coalesce"
           FROM ( SELECT sum(
                        CASE
                            WHEN (counted.verdict = 0) THEN (0)::bigint
                            ELSE counted.parts
                        END) AS parts
                   FROM ( SELECT measured_part.template,
                            measured_part.verdict,
                            1 AS parts
                           FROM public.measured_part
                          WHERE ((measured_part.run = run.id) AND (measured_part.is_superseded = 0) AND (measured_part.ended_us IS NOT NULL))
                        UNION ALL
                         SELECT archived_part.template,
                            archived_part.verdict,
                            archived_part.parts
                           FROM public.archived_part
                          WHERE (archived_part.run = run.id)) counted
                  GROUP BY counted.template) by_template))::bigint AS not_good,
    (( SELECT COALESCE(max(by_template.parts), (0)::numeric) AS "coalesce"
           FROM ( SELECT sum(
                        CASE
                            WHEN (counted.verdict = 2) THEN counted.parts
                            ELSE (0)::bigint
                        END) AS parts
                   FROM ( SELECT measured_part.template,
                            measured_part.verdict,
                            1 AS parts
                           FROM public.measured_part
                          WHERE ((measured_part.run = run.id) AND (measured_part.is_superseded = 0) AND (measured_part.ended_us IS NOT NULL))
                        UNION ALL
                         SELECT archived_part.template,
                            archived_part.verdict,
                            archived_part.parts
                           FROM public.archived_part
                          WHERE (archived_part.run = run.id)) counted
                  GROUP BY counted.template) by_template))::bigint AS rework,
    (( SELECT COALESCE(max(by_template.parts), (0)::numeric) AS "coalesce"
           FROM ( SELECT sum(
                        CASE
                            WHEN (counted.verdict = 3) THEN counted.parts
                            ELSE (0)::bigint
                        END) AS parts
                   FROM ( SELECT measured_part.template,
                            measured_part.verdict,
                            1 AS parts
                           FROM public.measured_part
                          WHERE ((measured_part.run = run.id) AND (measured_part.is_superseded = 0) AND (measured_part.ended_us IS NOT NULL))
                        UNION ALL
                         SELECT archived_part.template,
                            archived_part.verdict,
                            archived_part.parts
                           FROM public.archived_part
                          WHERE (archived_part.run = run.id)) counted
                  GROUP BY counted.template) by_template))::bigint AS scrap
   FROM public.run;


--
-- Name: job_count; Type: VIEW; Schema: public; Owner: -
--

CREATE VIEW public.job_count AS
 SELECT job.id AS job,
    (job.parts_per_run * ( SELECT count(*) AS count
           FROM public.run
          WHERE ((run.job = job.id) AND (run.state = 'completed'::text)))) AS made,
    (( SELECT COALESCE(sum(public.max((0)::bigint, public.min(v.good, (job.parts_per_run - v.not_good)))), (0)::numeric) AS "coalesce"
           FROM public.run_verdicts v
          WHERE ((v.job = job.id) AND (v.state = 'completed'::text))))::bigint AS good
   FROM public.job;


--
-- Name: job_hold; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.job_hold (
    machine bigint NOT NULL,
    who text NOT NULL COLLATE pg_catalog."C",
    reason text NOT NULL COLLATE pg_catalog."C",
    since_us bigint NOT NULL
);


--
-- Name: job_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.job ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.job_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: loaded_setup; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.loaded_setup (
    machine text NOT NULL COLLATE pg_catalog."C",
    number bigint,
    who text NOT NULL COLLATE pg_catalog."C",
    loaded_us bigint NOT NULL
);


--
-- Name: machine; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.machine (
    id bigint NOT NULL,
    name text NOT NULL COLLATE pg_catalog."C",
    control text NOT NULL COLLATE pg_catalog."C",
    description text NOT NULL COLLATE pg_catalog."C",
    gateway_version text NOT NULL COLLATE pg_catalog."C",
    epoch bigint NOT NULL,
    first_seen_us bigint NOT NULL,
    last_seen_us bigint NOT NULL,
    removed_us bigint
);


--
-- Name: machine_group; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.machine_group (
    name text NOT NULL COLLATE pg_catalog."C"
);


--
-- Name: machine_group_member; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.machine_group_member (
    machine_group text NOT NULL COLLATE pg_catalog."C",
    machine text NOT NULL COLLATE pg_catalog."C"
);


--
-- Name: machine_hold; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.machine_hold (
    machine bigint NOT NULL,
    run text NOT NULL COLLATE pg_catalog."C",
    who text NOT NULL COLLATE pg_catalog."C",
    reason text NOT NULL COLLATE pg_catalog."C",
    since_us bigint NOT NULL
);


--
-- Name: machine_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.machine ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.machine_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: measured_part_number; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.measured_part_number (
    last bigint NOT NULL
);


--
-- Name: measurement; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.measurement (
    id bigint NOT NULL,
    part bigint NOT NULL,
    machine bigint NOT NULL,
    name bigint NOT NULL,
    characteristic bigint NOT NULL,
    epoch bigint NOT NULL,
    number bigint NOT NULL,
    item bigint NOT NULL,
    time_us bigint NOT NULL,
    actual double precision NOT NULL,
    verdict bigint NOT NULL,
    block bigint NOT NULL,
    line bigint NOT NULL,
    is_superseded bigint DEFAULT 0 NOT NULL,
    CONSTRAINT measurement_is_superseded_check CHECK ((is_superseded = ANY (ARRAY[(0)::bigint, (1)::bigint]))),
    CONSTRAINT measurement_verdict_check CHECK (((verdict >= 0) AND (verdict <= 3)))
);


--
-- Name: measurement_cursor; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.measurement_cursor (
    machine bigint NOT NULL,
    epoch bigint NOT NULL,
    number bigint NOT NULL
);


--
-- Name: measurement_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.measurement ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.measurement_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: measurement_state; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.measurement_state (
    machine bigint NOT NULL,
    state text NOT NULL COLLATE pg_catalog."C"
);


--
-- Name: offset_proposal; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.offset_proposal (
    id bigint NOT NULL,
    machine text NOT NULL COLLATE pg_catalog."C",
    rule text NOT NULL COLLATE pg_catalog."C",
    target text NOT NULL COLLATE pg_catalog."C",
    unit text NOT NULL COLLATE pg_catalog."C",
    old_value double precision NOT NULL,
    new_value double precision NOT NULL,
    base bigint NOT NULL,
    state text DEFAULT 'pending'::text NOT NULL COLLATE pg_catalog."C",
    used bigint NOT NULL,
    left_out bigint NOT NULL,
    mean double precision NOT NULL,
    first bigint NOT NULL,
    last bigint NOT NULL,
    reasons text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    decided_us bigint,
    who text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    comment text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    is_automatic bigint DEFAULT 0 NOT NULL,
    setup bigint,
    CONSTRAINT offset_proposal_check CHECK (((state = 'applied'::text) = (setup IS NOT NULL))),
    CONSTRAINT offset_proposal_is_automatic_check CHECK ((is_automatic = ANY (ARRAY[(0)::bigint, (1)::bigint]))),
    CONSTRAINT offset_proposal_state_check CHECK ((state = ANY (ARRAY['pending'::text, 'applied'::text, 'rejected'::text, 'superseded'::text])))
);


--
-- Name: offset_proposal_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.offset_proposal ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.offset_proposal_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: offset_rules; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.offset_rules (
    machine text NOT NULL COLLATE pg_catalog."C",
    version bigint NOT NULL,
    text text NOT NULL COLLATE pg_catalog."C",
    author text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    CONSTRAINT offset_rules_version_check CHECK ((version >= 1))
);


--
-- Name: port; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.port (
    name text NOT NULL COLLATE pg_catalog."C",
    machine text NOT NULL COLLATE pg_catalog."C",
    address text NOT NULL COLLATE pg_catalog."C",
    line_template text NOT NULL COLLATE pg_catalog."C",
    rules text NOT NULL COLLATE pg_catalog."C",
    is_enabled bigint NOT NULL,
    host text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    CONSTRAINT port_is_enabled_check CHECK ((is_enabled = ANY (ARRAY[(0)::bigint, (1)::bigint])))
);


--
-- Name: port_setting; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.port_setting (
    port text NOT NULL COLLATE pg_catalog."C",
    "position" bigint NOT NULL,
    key text NOT NULL COLLATE pg_catalog."C",
    value text NOT NULL COLLATE pg_catalog."C",
    CONSTRAINT port_setting_position_check CHECK (("position" >= 0))
);


--
-- Name: port_transfer; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.port_transfer (
    port text NOT NULL COLLATE pg_catalog."C",
    direction text NOT NULL COLLATE pg_catalog."C",
    id text NOT NULL COLLATE pg_catalog."C",
    programs text NOT NULL COLLATE pg_catalog."C",
    size bigint NOT NULL,
    passed bigint NOT NULL,
    at_most bigint NOT NULL,
    state text NOT NULL COLLATE pg_catalog."C",
    reason text NOT NULL COLLATE pg_catalog."C",
    began_us bigint NOT NULL,
    ended_us bigint,
    after_run text COLLATE pg_catalog."C",
    CONSTRAINT port_transfer_at_most_check CHECK ((at_most >= 0)),
    CONSTRAINT port_transfer_check CHECK (((state = 'active'::text) = (ended_us IS NULL))),
    CONSTRAINT port_transfer_direction_check CHECK ((direction = ANY (ARRAY['send'::text, 'receive'::text]))),
    CONSTRAINT port_transfer_passed_check CHECK ((passed >= 0)),
    CONSTRAINT port_transfer_size_check CHECK ((size >= 0)),
    CONSTRAINT port_transfer_state_check CHECK ((state = ANY (ARRAY['active'::text, 'completed'::text, 'aborted'::text, 'interrupted'::text])))
);


--
-- Name: program; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.program (
    id bigint NOT NULL,
    name text NOT NULL COLLATE pg_catalog."C",
    removed_through bigint DEFAULT 0 NOT NULL,
    part text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    operation text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    material text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    machine_group text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    latest bigint,
    revisions bigint DEFAULT 0 NOT NULL,
    held bigint DEFAULT 0 NOT NULL,
    released bigint,
    latest_control text COLLATE pg_catalog."C",
    latest_author text COLLATE pg_catalog."C",
    latest_state text COLLATE pg_catalog."C"
);


--
-- Name: program_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.program ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.program_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: record; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.record (
    machine bigint NOT NULL,
    epoch bigint NOT NULL,
    number bigint NOT NULL,
    time_us bigint NOT NULL,
    run text COLLATE pg_catalog."C",
    kind text NOT NULL COLLATE pg_catalog."C",
    block bigint NOT NULL,
    line bigint NOT NULL,
    sequence bigint NOT NULL,
    device text NOT NULL COLLATE pg_catalog."C",
    text text NOT NULL COLLATE pg_catalog."C",
    received_us bigint,
    CONSTRAINT record_number_check CHECK ((number >= 1))
);


--
-- Name: record_cursor; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.record_cursor (
    reader text NOT NULL COLLATE pg_catalog."C",
    machine bigint NOT NULL,
    epoch bigint NOT NULL,
    number bigint NOT NULL
);


--
-- Name: record_epoch; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.record_epoch (
    machine bigint NOT NULL,
    epoch bigint NOT NULL,
    last bigint NOT NULL
);


--
-- Name: record_reader; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.record_reader (
    name text NOT NULL COLLATE pg_catalog."C",
    since_us bigint NOT NULL
);


--
-- Name: report_finding; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.report_finding (
    id bigint NOT NULL,
    machine bigint NOT NULL,
    part bigint,
    run text COLLATE pg_catalog."C",
    epoch bigint NOT NULL,
    number bigint NOT NULL,
    time_us bigint NOT NULL,
    kind text NOT NULL COLLATE pg_catalog."C",
    text text NOT NULL COLLATE pg_catalog."C",
    is_superseded bigint DEFAULT 0 NOT NULL,
    CONSTRAINT report_finding_is_superseded_check CHECK ((is_superseded = ANY (ARRAY[(0)::bigint, (1)::bigint])))
);


--
-- Name: report_finding_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.report_finding ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.report_finding_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: report_template; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.report_template (
    name text NOT NULL COLLATE pg_catalog."C",
    version bigint NOT NULL,
    text text NOT NULL COLLATE pg_catalog."C",
    author text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    is_removed bigint DEFAULT 0 NOT NULL,
    CONSTRAINT report_template_is_removed_check CHECK ((is_removed = ANY (ARRAY[(0)::bigint, (1)::bigint]))),
    CONSTRAINT report_template_version_check CHECK ((version >= 1))
);


--
-- Name: report_template_assignment; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.report_template_assignment (
    scope text NOT NULL COLLATE pg_catalog."C",
    subject text NOT NULL COLLATE pg_catalog."C",
    template text NOT NULL COLLATE pg_catalog."C",
    version bigint,
    author text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    CONSTRAINT report_template_assignment_scope_check CHECK ((scope = ANY (ARRAY['program'::text, 'machine'::text, 'macro'::text])))
);


--
-- Name: revision; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.revision (
    program bigint NOT NULL,
    number bigint NOT NULL,
    content bigint NOT NULL,
    control text NOT NULL COLLATE pg_catalog."C",
    comment text NOT NULL COLLATE pg_catalog."C",
    author text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    standing text DEFAULT 'accepted'::text NOT NULL COLLATE pg_catalog."C",
    accepted_us bigint,
    sha256 bytea,
    state text DEFAULT 'draft'::text NOT NULL COLLATE pg_catalog."C",
    released_us bigint,
    withdrawn_us bigint,
    cam_file text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    in_force_after bigint,
    released_after bigint,
    withdrawn_after bigint,
    CONSTRAINT revision_number_check CHECK ((number >= 1)),
    CONSTRAINT revision_sha256_check CHECK ((length(sha256) = 32)),
    CONSTRAINT revision_standing_check CHECK ((standing = ANY (ARRAY['accepted'::text, 'held'::text, 'rejected'::text]))),
    CONSTRAINT revision_state_check CHECK ((state = ANY (ARRAY['draft'::text, 'in_review'::text, 'approved'::text, 'released'::text, 'withdrawn'::text])))
);


--
-- Name: revision_pin; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.revision_pin (
    step bigint NOT NULL,
    "position" bigint NOT NULL,
    program bigint NOT NULL,
    revision bigint NOT NULL,
    name text NOT NULL COLLATE pg_catalog."C",
    sha256 bytea NOT NULL,
    CONSTRAINT revision_pin_position_check CHECK (("position" >= 0)),
    CONSTRAINT revision_pin_sha256_check CHECK ((length(sha256) = 32))
);


--
-- Name: revision_step; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.revision_step (
    id bigint NOT NULL,
    program bigint NOT NULL,
    revision bigint NOT NULL,
    name text NOT NULL COLLATE pg_catalog."C",
    sha256 bytea NOT NULL,
    step text NOT NULL COLLATE pg_catalog."C",
    time_us bigint NOT NULL,
    who text NOT NULL COLLATE pg_catalog."C",
    credential text NOT NULL COLLATE pg_catalog."C",
    address text NOT NULL COLLATE pg_catalog."C",
    comment text NOT NULL COLLATE pg_catalog."C",
    policy bytea NOT NULL,
    signature bytea NOT NULL,
    closure bigint,
    CONSTRAINT revision_step_check CHECK (((closure IS NULL) OR (step = 'release'::text))),
    CONSTRAINT revision_step_policy_check CHECK ((length(policy) = 32)),
    CONSTRAINT revision_step_sha256_check CHECK ((length(sha256) = 32)),
    CONSTRAINT revision_step_signature_check CHECK ((length(signature) = 64)),
    CONSTRAINT revision_step_step_check CHECK ((step = ANY (ARRAY['submit'::text, 'approve'::text, 'reject'::text, 'release'::text, 'withdraw'::text])))
);


--
-- Name: revision_step_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.revision_step ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.revision_step_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: run_call; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.run_call (
    run bigint NOT NULL,
    name text NOT NULL COLLATE pg_catalog."C",
    program bigint NOT NULL,
    revision bigint NOT NULL,
    sha256 bytea NOT NULL,
    CONSTRAINT run_call_sha256_check CHECK ((length(sha256) = 32))
);


--
-- Name: run_number_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.run ALTER COLUMN number ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.run_number_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: schema_version; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.schema_version (
    version bigint NOT NULL
);


--
-- Name: search_document; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.search_document (
    id bigint NOT NULL,
    program bigint NOT NULL,
    revision bigint NOT NULL,
    words text NOT NULL COLLATE pg_catalog."C",
    text bigint NOT NULL
);


--
-- Name: search_document_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.search_document ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.search_document_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Name: search_due; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.search_due (
    program bigint NOT NULL,
    version bigint DEFAULT 1 NOT NULL
);


--
-- Name: search_index; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.search_index (
    id bigint NOT NULL,
    words tsvector NOT NULL
);


--
-- Name: search_word; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.search_word (
    word text NOT NULL COLLATE pg_catalog."C"
);


--
-- Name: setup; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.setup (
    machine text NOT NULL COLLATE pg_catalog."C",
    number bigint NOT NULL,
    text text NOT NULL COLLATE pg_catalog."C",
    sha256 bytea NOT NULL,
    comment text NOT NULL COLLATE pg_catalog."C",
    author text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    CONSTRAINT setup_number_check CHECK ((number > 0)),
    CONSTRAINT setup_sha256_check CHECK ((length(sha256) = 32))
);


--
-- Name: store_holder; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.store_holder (
    id bigint NOT NULL,
    holder text NOT NULL COLLATE pg_catalog."C",
    described text NOT NULL COLLATE pg_catalog."C",
    until timestamp with time zone NOT NULL,
    term bigint DEFAULT 0 NOT NULL,
    url text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    signing_key text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    settings text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    own_hand_overs bigint DEFAULT 0 NOT NULL,
    has_helped integer DEFAULT 1 NOT NULL,
    CONSTRAINT store_holder_has_helped_check CHECK ((has_helped = ANY (ARRAY[0, 1]))),
    CONSTRAINT store_holder_id_check CHECK ((id = 1)),
    CONSTRAINT store_holder_own_hand_overs_check CHECK ((own_hand_overs >= 0)),
    CONSTRAINT store_holder_term_check CHECK ((term >= 0))
);


--
-- Name: store_standby; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.store_standby (
    holder text NOT NULL COLLATE pg_catalog."C",
    described text NOT NULL COLLATE pg_catalog."C",
    seen timestamp with time zone NOT NULL,
    gateways bigint,
    CONSTRAINT store_standby_gateways_check CHECK ((gateways >= 0))
);


--
-- Name: upload; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.upload (
    id text NOT NULL COLLATE pg_catalog."C",
    program text NOT NULL COLLATE pg_catalog."C",
    control text NOT NULL COLLATE pg_catalog."C",
    comment text NOT NULL COLLATE pg_catalog."C",
    author text NOT NULL COLLATE pg_catalog."C",
    content bigint NOT NULL,
    created_us bigint NOT NULL,
    touched_us bigint NOT NULL,
    held bigint DEFAULT 0 NOT NULL,
    idle_seconds bigint DEFAULT 0 NOT NULL,
    part text COLLATE pg_catalog."C",
    operation text COLLATE pg_catalog."C",
    material text COLLATE pg_catalog."C",
    machine_group text COLLATE pg_catalog."C",
    cam_file text COLLATE pg_catalog."C",
    attachment text COLLATE pg_catalog."C",
    attachment_revision bigint,
    folder_file bigint,
    CONSTRAINT upload_held_check CHECK ((held = ANY (ARRAY[(0)::bigint, (1)::bigint])))
);


--
-- Name: user; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public."user" (
    name text NOT NULL COLLATE pg_catalog."C",
    role text NOT NULL COLLATE pg_catalog."C",
    password text NOT NULL COLLATE pg_catalog."C",
    state text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    signed_in_us bigint,
    CONSTRAINT user_role_check CHECK ((role = ANY (ARRAY['viewer'::text, 'operator'::text, 'programmer'::text, 'approver'::text, 'administrator'::text]))),
    CONSTRAINT user_state_check CHECK ((state = ANY (ARRAY['active'::text, 'locked'::text, 'removed'::text])))
);


--
-- Name: user_group; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.user_group (
    "user" text NOT NULL COLLATE pg_catalog."C",
    machine_group text NOT NULL COLLATE pg_catalog."C"
);


--
-- Name: webhook; Type: TABLE; Schema: public; Owner: -
--

CREATE TABLE public.webhook (
    id bigint NOT NULL,
    name text NOT NULL COLLATE pg_catalog."C",
    url text NOT NULL COLLATE pg_catalog."C",
    secret text NOT NULL COLLATE pg_catalog."C",
    kinds text NOT NULL COLLATE pg_catalog."C",
    author text NOT NULL COLLATE pg_catalog."C",
    created_us bigint NOT NULL,
    delivered bigint NOT NULL,
    delivered_us bigint,
    failures bigint DEFAULT 0 NOT NULL,
    failing_since_us bigint,
    fault text DEFAULT ''::text NOT NULL COLLATE pg_catalog."C",
    lost bigint DEFAULT 0 NOT NULL
);


--
-- Name: webhook_id_seq; Type: SEQUENCE; Schema: public; Owner: -
--

ALTER TABLE public.webhook ALTER COLUMN id ADD GENERATED BY DEFAULT AS IDENTITY (
    SEQUENCE NAME public.webhook_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);


--
-- Data for Name: archive; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.archive VALUES (1, 'records', 'm1', 3, 1, 4, 1, 'records-m1-3-1.jsonl.zst', '\x0000000000000000000000000000000000000000000000000000000000000000', 4, 120, 1700000000000000, 1700000000000001, 1700000000000015, 1);
INSERT INTO public.archive VALUES (2, 'measurements', '', 0, 1, 2, 1, 'measurements-1.jsonl.zst', '\x0000000000000000000000000000000000000000000000000000000000000000', 4, 120, 1700000000000000, 1700000000000001, 1700000000000016, 1);


--
-- Data for Name: archived_part; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.archived_part VALUES ('r1', 2, 'bore', 0, 2);


--
-- Data for Name: attachment; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.attachment VALUES (1, 1, NULL, 'setup.txt', 1, '\x82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450', 'side 1', 'anna', 1700000000000000);


--
-- Data for Name: audit; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.audit VALUES (1, 1700000000000000, 'cam', 'push', 'p.nc', '{}', '', '', '\x741b05f7258199f09569020856a7528d48a197d887966cc43483818c41fa19fd');
INSERT INTO public.audit VALUES (2, 5, 'server', 'run.end', 'r1', 'completed on m1: p.nc revision 1, 2 blocks executed: M30; run sha256 54fca436968d995ef9f97f78cdc1015b0a6633106993fbaa24ae72cc0a404cbd', '', '', '\xf2cba5ad89cbcaea8fcf887c502a3f6c684752ebff053f6d28c6805ea0d20438');


--
-- Data for Name: audit_checkpoint; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.audit_checkpoint VALUES (1, 2, 1700000000000009, '\xf2cba5ad89cbcaea8fcf887c502a3f6c684752ebff053f6d28c6805ea0d20438', '\x00000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000');


--
-- Data for Name: characteristic; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.characteristic VALUES (1, 1, 2, 1.99, 2.01, 'mm', 3, 'T3');


--
-- Data for Name: characteristic_name; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.characteristic_name VALUES (1, 'X');


--
-- Data for Name: chunk; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.chunk VALUES (1, '\x82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450', 12, '\x28b52ffd200c6100004730302058312e0a4d33300a');
INSERT INTO public.chunk VALUES (2, '\x3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1', 12, '\x28b52ffd200c6100004730302058322e0a4d33300a');
INSERT INTO public.chunk VALUES (3, '\xda2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0', 3, '\x28b52ffd20031900004d320a');
INSERT INTO public.chunk VALUES (4, '\x0a27cc5fb7f6b883d3e37bcf448557ee9de5c29b0d287b430b6711679db8238d', 5, '\x28b52ffd20052900004730312058');


--
-- Data for Name: content; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.content VALUES (1, '\x82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450', 12, '\x3b6ea2c697a313fb073b594cec24d2b81cc2b99a5928cd6170e594759432c686');
INSERT INTO public.content VALUES (2, '\x3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1', 12, '\xf512ce5eddecd367b7fb4fa1eff6003d54d600a8cfaa4d82e17920eaabd59f11');
INSERT INTO public.content VALUES (3, '\xda2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0', 3, '\xb6070dfadd1cf9f3a1adda6fec80d212dd9c28748ccabe0bbd133844ee4717b0');
INSERT INTO public.content VALUES (4, NULL, 5, NULL);


--
-- Data for Name: content_chunk; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.content_chunk VALUES (1, 0, 1, '\x82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450');
INSERT INTO public.content_chunk VALUES (2, 0, 2, '\x3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1');
INSERT INTO public.content_chunk VALUES (3, 0, 3, '\xda2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0');
INSERT INTO public.content_chunk VALUES (4, 0, 4, '\x0a27cc5fb7f6b883d3e37bcf448557ee9de5c29b0d287b430b6711679db8238d');


--
-- Data for Name: credential; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.credential VALUES ('admin', 'local', 'token', '\x82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450', 'administrator', 0, 1700000000000005, NULL, NULL, '');
INSERT INTO public.credential VALUES ('anna', 'dashboard', 'token', '\xda2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0', 'viewer', 1, 1700000000000003, 1800000000000000, 1700000000000004, '192.0.2.7');


--
-- Data for Name: credential_group; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.credential_group VALUES ('anna', 'dashboard', 'lathes');


--
-- Data for Name: event; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.event VALUES (1, 1700000000000000, 'run', '{"run":"r1"}');
INSERT INTO public.event VALUES (3, 1795829803625000, 'job', '{"change":"added","job":2,"machine":"m1","program":"p.nc","revision":null,"quantity":5,"completed":0}');
INSERT INTO public.event VALUES (4, 1795980109704000, 'run', '{"run":"r3","state":"tested","machine":"m1","program":"p.nc","revision":1,"author":"operator","job":null,"executed":0,"reason":"test run: 2 blocks"}');


--
-- Data for Name: folder_file; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.folder_file VALUES (1, 'cam', 'p.nc', '\x3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1', 11, 1700000000000000000, 'stored', 'p.nc', 2, '', 'done/p.nc', 1700000000000000, NULL);


--
-- Data for Name: identity; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.identity VALUES ('0123456789abcdef0123456789abcdef');


--
-- Data for Name: import; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.import VALUES (1, 3, 'm1', 'pending', 2, 'geometry', '', 1700000000000012, NULL, '', '', 0, '', NULL);


--
-- Data for Name: job; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.job VALUES (1, 1, 1, 1, NULL, 3, 1, 'steel', 'anna', 1700000000000000, NULL, 'made');
INSERT INTO public.job VALUES (2, 1, 2, 1, NULL, 5, 1, '', 'anna', 1700000000000016, NULL, 'good');


--
-- Data for Name: job_hold; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.job_hold VALUES (1, 'quality', 'bore is wide', 1700000000000000);


--
-- Data for Name: loaded_setup; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.loaded_setup VALUES ('m1', 1, 'anna', 1700000000000018);


--
-- Data for Name: machine; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.machine VALUES (1, 'm1', 'centurion', '', '', 7, 1700000000000000, 1700000000000000, NULL);
INSERT INTO public.machine VALUES (2, 'm9', 'centurion', '', '', 1, 1, 2, 3);


--
-- Data for Name: machine_group; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.machine_group VALUES ('all');
INSERT INTO public.machine_group VALUES ('lathes');


--
-- Data for Name: machine_group_member; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.machine_group_member VALUES ('lathes', 'm1');


--
-- Data for Name: machine_hold; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.machine_hold VALUES (1, 'r2', 'report template bore version 1', 'part 1 S7 is scrap', 1700000000000017);


--
-- Data for Name: measured_part; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.measured_part VALUES (1, 1, 'r1', 'p.nc', 1, 'bore', 1, '', 'S7', 1, 1, 2, 1700000000000003, 1700000000000004, 0);


--
-- Data for Name: measured_part_number; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.measured_part_number VALUES (1);


--
-- Data for Name: measurement; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.measurement VALUES (1, 1, 1, 1, 1, 7, 2, 0, 1000002, 1.5, 2, 20, 22, 0);


--
-- Data for Name: measurement_cursor; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.measurement_cursor VALUES (1, 7, 3);


--
-- Data for Name: measurement_state; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.measurement_state VALUES (1, '');


--
-- Data for Name: offset_proposal; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.offset_proposal VALUES (1, 'm1', 'bore', 'T3.wear.X', 'mm', 0, -0.02, 1, 'applied', 5, 1, 0.02, 1, 1, '["mean 0.02"]', 1700000000000000, 1700000001000000, 'quality', '', 0, 2);
INSERT INTO public.offset_proposal VALUES (2, 'm1', 'bore', 'T3.wear.X', 'mm', -0.02, -0.03, 2, 'pending', 5, 0, 0.01, 1, 1, '["mean 0.01"]', 1700000002000000, NULL, '', '', 0, NULL);


--
-- Data for Name: offset_rules; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.offset_rules VALUES ('m1', 1, '[[rule]]
', 'quality', 1700000000000000);


--
-- Data for Name: port; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.port VALUES ('line-1', 'm1', '/dev/ttyUSB0', 'tnc155', '[[rule]]
', 1, '');


--
-- Data for Name: port_setting; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.port_setting VALUES ('line-1', 0, 'baud', '4800');
INSERT INTO public.port_setting VALUES ('line-1', 1, 'flow', 'xonxoff');


--
-- Data for Name: port_transfer; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.port_transfer VALUES ('line-1', 'receive', 'reception-1', '', 0, 100, 100, 'interrupted', 'the line is lost', 1700000000000000, 1700000001000000, NULL);
INSERT INTO public.port_transfer VALUES ('line-1', 'send', 'transfer-1', 'p.nc revision 1
p.nc revision 2', 26, 12, 26, 'active', '', 1700000000000000, NULL, 'r1');


--
-- Data for Name: program; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.program VALUES (1, 'p.nc', 0, '4711', '', '', 'lathes', 2, 3, 1, NULL, 'centurion', 'cam', 'draft');
INSERT INTO public.program VALUES (2, 'gone.nc', 1, '', '', '', '', NULL, 0, 0, NULL, NULL, NULL, NULL);


--
-- Data for Name: record; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.record VALUES (1, 7, 1, 1000001, 'r1', 'run_started', 10, 11, 12, 'port1', 'X1', 1001501);
INSERT INTO public.record VALUES (1, 7, 2, 1000002, 'r1', 'output', 20, 22, 24, 'port1', 'X2', 1001502);
INSERT INTO public.record VALUES (1, 7, 3, 1000003, 'r1', 'run_ended', 30, 33, 36, 'port1', 'X3', 1001503);


--
-- Data for Name: record_cursor; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.record_cursor VALUES ('mqtt', 1, 7, 2);


--
-- Data for Name: record_epoch; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.record_epoch VALUES (1, 7, 3);


--
-- Data for Name: record_reader; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.record_reader VALUES ('mqtt', 1700000000000000);


--
-- Data for Name: report_finding; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.report_finding VALUES (1, 1, 1, 'r1', 7, 2, 1000002, 'unmatched', 'X3', 0);


--
-- Data for Name: report_template; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.report_template VALUES ('bore', 1, '[[line]]
form = "X{actual}"
characteristic = "X"
', 'anna', 1700000000000013, 0);


--
-- Data for Name: report_template_assignment; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.report_template_assignment VALUES ('program', 'p.nc', 'bore', NULL, 'anna', 1700000000000014);


--
-- Data for Name: revision; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.revision VALUES (1, 2, 2, 'centurion', 'a comment', 'cam', 1700000000000000, 'accepted', NULL, '\x3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1', 'draft', NULL, NULL, 'p.f3d', NULL, NULL, NULL);
INSERT INTO public.revision VALUES (1, 3, 3, 'centurion', 'punched', 'machine m1', 1700000000000000, 'held', NULL, '\xda2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0', 'draft', NULL, NULL, '', NULL, NULL, NULL);
INSERT INTO public.revision VALUES (2, 1, 3, 'centurion', 'a comment', 'cam', 1700000000000000, 'accepted', NULL, '\xda2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0', 'draft', NULL, NULL, '', NULL, NULL, NULL);
INSERT INTO public.revision VALUES (1, 1, 1, 'centurion', 'a comment', 'cam', 1700000000000000, 'accepted', NULL, '\x82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450', 'withdrawn', NULL, 1700000000000011, '', 0, NULL, 3);


--
-- Data for Name: revision_pin; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: revision_step; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.revision_step VALUES (1, 1, 1, 'p.nc', '\x82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450', 'withdraw', 1700000000000011, 'anna', 'dashboard', '192.0.2.7', 'scrap', '\x0000000000000000000000000000000000000000000000000000000000000000', '\x00000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000', NULL);


--
-- Data for Name: run; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.run VALUES (1, 'r1', 1, 1, 1, 'centurion', 'completed', 12, 2, 2, 0, -1, 'M30', NULL, 1, 'operator', 1700000000000000, 3, 5, 1, 1, '\x82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450', 'open', NULL, 1, NULL, 12.5, 250.75, 0);
INSERT INTO public.run VALUES (2, 'r2', 1, 1, 2, 'centurion', 'active', 0, 0, 0, 0, -1, '', NULL, NULL, 'operator', 1700000000000000, NULL, NULL, 0, NULL, '\x3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1', 'open', NULL, NULL, 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa', NULL, NULL, 0);
INSERT INTO public.run VALUES (3, 'r3', 1, 1, 1, 'centurion', 'tested', 12, 2, 0, 0, -1, 'test run: 2 blocks', NULL, 1, 'operator', 1700000000000000, 3, 5, 0, 1, '\x82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450', 'open', NULL, NULL, NULL, NULL, NULL, 0);


--
-- Data for Name: run_call; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.run_call VALUES (2, '1', 1, 1, '\x82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450');


--
-- Data for Name: schema_version; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.schema_version VALUES (13);


--
-- Data for Name: search_document; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: search_due; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.search_due VALUES (1, 1);
INSERT INTO public.search_due VALUES (2, 1);


--
-- Data for Name: search_index; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: search_word; Type: TABLE DATA; Schema: public; Owner: -
--



--
-- Data for Name: setup; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.setup VALUES ('m1', 1, '[[tool]]
number = 4
', '\x0416fea2bfc67a7cd21fc2db7de3ddab9c6552143817fea43dc7bc5d4cb516d9', 'first', 'admin', 1000001);
INSERT INTO public.setup VALUES ('m1', 2, '[[tool]]
number = 5
', '\xcad87e0771e182e3b37c43e74b9def6152200a4a6421e44c4f79144afdc53a60', 'second', 'admin', 1000002);


--
-- Data for Name: upload; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.upload VALUES ('u1', 'half.nc', '', '', 'cam', 4, 1700000000000000, 1700000000000000, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL);


--
-- Data for Name: user; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public."user" VALUES ('admin', 'administrator', '', 'active', 1700000000000000, NULL);
INSERT INTO public."user" VALUES ('anna', 'operator', '$argon2id$v=19$m=8,t=1,p=1$YWJjZGVmZ2hpamtsbW5vcA$xSmTDI3YzgyM5XIcT1qPTbwgxqGvmMG6cTdiSkmAPws', 'locked', 1700000000000001, 1700000000000009);
INSERT INTO public."user" VALUES ('bert', 'viewer', '', 'removed', 1700000000000002, NULL);


--
-- Data for Name: user_group; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.user_group VALUES ('admin', 'all');
INSERT INTO public.user_group VALUES ('anna', 'lathes');


--
-- Data for Name: webhook; Type: TABLE DATA; Schema: public; Owner: -
--

INSERT INTO public.webhook VALUES (1, 'erp', 'https://erp.example/', 's3cret', 'run,alarm', 'admin', 1700000000000000, 0, NULL, 0, NULL, '', 0);


--
-- Name: archive_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.archive_id_seq', 2, true);


--
-- Name: attachment_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.attachment_id_seq', 1, true);


--
-- Name: characteristic_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.characteristic_id_seq', 1, true);


--
-- Name: characteristic_name_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.characteristic_name_id_seq', 1, true);


--
-- Name: chunk_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.chunk_id_seq', 4, true);


--
-- Name: content_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.content_id_seq', 4, true);


--
-- Name: event_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.event_id_seq', 4, true);


--
-- Name: folder_file_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.folder_file_id_seq', 1, true);


--
-- Name: job_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.job_id_seq', 2, true);


--
-- Name: machine_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.machine_id_seq', 2, true);


--
-- Name: measurement_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.measurement_id_seq', 1, true);


--
-- Name: offset_proposal_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.offset_proposal_id_seq', 2, true);


--
-- Name: program_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.program_id_seq', 2, true);


--
-- Name: report_finding_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.report_finding_id_seq', 1, true);


--
-- Name: revision_step_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.revision_step_id_seq', 1, true);


--
-- Name: run_number_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.run_number_seq', 2, true);


--
-- Name: search_document_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.search_document_id_seq', 1, false);


--
-- Name: webhook_id_seq; Type: SEQUENCE SET; Schema: public; Owner: -
--

SELECT pg_catalog.setval('public.webhook_id_seq', 1, true);


--
-- Name: archive archive_file_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.archive
    ADD CONSTRAINT archive_file_key UNIQUE (file);


--
-- Name: archive archive_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.archive
    ADD CONSTRAINT archive_pkey PRIMARY KEY (id);


--
-- Name: archived_part archived_part_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.archived_part
    ADD CONSTRAINT archived_part_pkey PRIMARY KEY (run, archive, template, verdict);


--
-- Name: attachment attachment_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.attachment
    ADD CONSTRAINT attachment_pkey PRIMARY KEY (id);


--
-- Name: audit_checkpoint audit_checkpoint_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.audit_checkpoint
    ADD CONSTRAINT audit_checkpoint_pkey PRIMARY KEY (number);


--
-- Name: audit audit_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.audit
    ADD CONSTRAINT audit_pkey PRIMARY KEY (id);


--
-- Name: characteristic_name characteristic_name_name_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.characteristic_name
    ADD CONSTRAINT characteristic_name_name_key UNIQUE (name);


--
-- Name: characteristic_name characteristic_name_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.characteristic_name
    ADD CONSTRAINT characteristic_name_pkey PRIMARY KEY (id);


--
-- Name: characteristic characteristic_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.characteristic
    ADD CONSTRAINT characteristic_pkey PRIMARY KEY (id);


--
-- Name: chunk chunk_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.chunk
    ADD CONSTRAINT chunk_pkey PRIMARY KEY (id);


--
-- Name: chunk chunk_sha256_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.chunk
    ADD CONSTRAINT chunk_sha256_key UNIQUE (sha256);


--
-- Name: content_chunk content_chunk_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.content_chunk
    ADD CONSTRAINT content_chunk_pkey PRIMARY KEY (content, "position");


--
-- Name: content content_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.content
    ADD CONSTRAINT content_pkey PRIMARY KEY (id);


--
-- Name: content content_sha256_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.content
    ADD CONSTRAINT content_sha256_key UNIQUE (sha256);


--
-- Name: credential_group credential_group_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.credential_group
    ADD CONSTRAINT credential_group_pkey PRIMARY KEY ("user", name, machine_group);


--
-- Name: credential credential_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.credential
    ADD CONSTRAINT credential_pkey PRIMARY KEY ("user", name);


--
-- Name: credential credential_sha256_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.credential
    ADD CONSTRAINT credential_sha256_key UNIQUE (sha256);


--
-- Name: event event_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.event
    ADD CONSTRAINT event_pkey PRIMARY KEY (id);


--
-- Name: folder_file folder_file_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.folder_file
    ADD CONSTRAINT folder_file_pkey PRIMARY KEY (id);


--
-- Name: identity identity_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.identity
    ADD CONSTRAINT identity_pkey PRIMARY KEY (id);


--
-- Name: import import_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.import
    ADD CONSTRAINT import_pkey PRIMARY KEY (program, revision);


--
-- Name: job_hold job_hold_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.job_hold
    ADD CONSTRAINT job_hold_pkey PRIMARY KEY (machine);


--
-- Name: job job_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.job
    ADD CONSTRAINT job_pkey PRIMARY KEY (id);


--
-- Name: loaded_setup loaded_setup_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.loaded_setup
    ADD CONSTRAINT loaded_setup_pkey PRIMARY KEY (machine);


--
-- Name: machine_group_member machine_group_member_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.machine_group_member
    ADD CONSTRAINT machine_group_member_pkey PRIMARY KEY (machine_group, machine);


--
-- Name: machine_group machine_group_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.machine_group
    ADD CONSTRAINT machine_group_pkey PRIMARY KEY (name);


--
-- Name: machine_hold machine_hold_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.machine_hold
    ADD CONSTRAINT machine_hold_pkey PRIMARY KEY (machine);


--
-- Name: machine machine_name_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.machine
    ADD CONSTRAINT machine_name_key UNIQUE (name);


--
-- Name: machine machine_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.machine
    ADD CONSTRAINT machine_pkey PRIMARY KEY (id);


--
-- Name: measured_part measured_part_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.measured_part
    ADD CONSTRAINT measured_part_pkey PRIMARY KEY (id);


--
-- Name: measurement_cursor measurement_cursor_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.measurement_cursor
    ADD CONSTRAINT measurement_cursor_pkey PRIMARY KEY (machine, epoch);


--
-- Name: measurement measurement_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.measurement
    ADD CONSTRAINT measurement_pkey PRIMARY KEY (id);


--
-- Name: measurement_state measurement_state_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.measurement_state
    ADD CONSTRAINT measurement_state_pkey PRIMARY KEY (machine);


--
-- Name: offset_proposal offset_proposal_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.offset_proposal
    ADD CONSTRAINT offset_proposal_pkey PRIMARY KEY (id);


--
-- Name: offset_rules offset_rules_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.offset_rules
    ADD CONSTRAINT offset_rules_pkey PRIMARY KEY (machine, version);


--
-- Name: port port_address_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.port
    ADD CONSTRAINT port_address_key UNIQUE (address);


--
-- Name: port port_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.port
    ADD CONSTRAINT port_pkey PRIMARY KEY (name);


--
-- Name: port_setting port_setting_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.port_setting
    ADD CONSTRAINT port_setting_pkey PRIMARY KEY (port, "position");


--
-- Name: port_setting port_setting_port_key_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.port_setting
    ADD CONSTRAINT port_setting_port_key_key UNIQUE (port, key);


--
-- Name: port_transfer port_transfer_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.port_transfer
    ADD CONSTRAINT port_transfer_pkey PRIMARY KEY (port, direction);


--
-- Name: program program_name_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.program
    ADD CONSTRAINT program_name_key UNIQUE (name);


--
-- Name: program program_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.program
    ADD CONSTRAINT program_pkey PRIMARY KEY (id);


--
-- Name: record_cursor record_cursor_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.record_cursor
    ADD CONSTRAINT record_cursor_pkey PRIMARY KEY (reader, machine, epoch);


--
-- Name: record_epoch record_epoch_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.record_epoch
    ADD CONSTRAINT record_epoch_pkey PRIMARY KEY (machine, epoch);


--
-- Name: record record_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.record
    ADD CONSTRAINT record_pkey PRIMARY KEY (machine, epoch, number);


--
-- Name: record_reader record_reader_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.record_reader
    ADD CONSTRAINT record_reader_pkey PRIMARY KEY (name);


--
-- Name: report_finding report_finding_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.report_finding
    ADD CONSTRAINT report_finding_pkey PRIMARY KEY (id);


--
-- Name: report_template_assignment report_template_assignment_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.report_template_assignment
    ADD CONSTRAINT report_template_assignment_pkey PRIMARY KEY (scope, subject, template);


--
-- Name: report_template report_template_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.report_template
    ADD CONSTRAINT report_template_pkey PRIMARY KEY (name, version);


--
-- Name: revision_pin revision_pin_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.revision_pin
    ADD CONSTRAINT revision_pin_pkey PRIMARY KEY (step, "position");


--
-- Name: revision revision_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.revision
    ADD CONSTRAINT revision_pkey PRIMARY KEY (program, number);


--
-- Name: revision_step revision_step_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.revision_step
    ADD CONSTRAINT revision_step_pkey PRIMARY KEY (id);


--
-- Name: run_call run_call_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.run_call
    ADD CONSTRAINT run_call_pkey PRIMARY KEY (run, name);


--
-- Name: run run_id_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.run
    ADD CONSTRAINT run_id_key UNIQUE (id);


--
-- Name: run run_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.run
    ADD CONSTRAINT run_pkey PRIMARY KEY (number);


--
-- Name: search_document search_document_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.search_document
    ADD CONSTRAINT search_document_pkey PRIMARY KEY (id);


--
-- Name: search_document search_document_program_revision_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.search_document
    ADD CONSTRAINT search_document_program_revision_key UNIQUE (program, revision);


--
-- Name: search_due search_due_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.search_due
    ADD CONSTRAINT search_due_pkey PRIMARY KEY (program);


--
-- Name: search_index search_index_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.search_index
    ADD CONSTRAINT search_index_pkey PRIMARY KEY (id);


--
-- Name: search_word search_word_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.search_word
    ADD CONSTRAINT search_word_pkey PRIMARY KEY (word);


--
-- Name: setup setup_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.setup
    ADD CONSTRAINT setup_pkey PRIMARY KEY (machine, number);


--
-- Name: store_holder store_holder_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.store_holder
    ADD CONSTRAINT store_holder_pkey PRIMARY KEY (id);


--
-- Name: store_standby store_standby_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.store_standby
    ADD CONSTRAINT store_standby_pkey PRIMARY KEY (holder);


--
-- Name: upload upload_content_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.upload
    ADD CONSTRAINT upload_content_key UNIQUE (content);


--
-- Name: upload upload_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.upload
    ADD CONSTRAINT upload_pkey PRIMARY KEY (id);


--
-- Name: user_group user_group_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.user_group
    ADD CONSTRAINT user_group_pkey PRIMARY KEY ("user", machine_group);


--
-- Name: user user_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public."user"
    ADD CONSTRAINT user_pkey PRIMARY KEY (name);


--
-- Name: webhook webhook_name_key; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.webhook
    ADD CONSTRAINT webhook_name_key UNIQUE (name);


--
-- Name: webhook webhook_pkey; Type: CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.webhook
    ADD CONSTRAINT webhook_pkey PRIMARY KEY (id);


--
-- Name: attachment_by_content; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX attachment_by_content ON public.attachment USING btree (content);


--
-- Name: attachment_by_digest; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX attachment_by_digest ON public.attachment USING btree (sha256);


--
-- Name: attachment_by_name; Type: INDEX; Schema: public; Owner: -
--

CREATE UNIQUE INDEX attachment_by_name ON public.attachment USING btree (program, COALESCE(revision, (0)::bigint), name);


--
-- Name: audit_run_end; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX audit_run_end ON public.audit USING btree (subject) WHERE (action = 'run.end'::text);


--
-- Name: characteristic_by_value; Type: INDEX; Schema: public; Owner: -
--

CREATE UNIQUE INDEX characteristic_by_value ON public.characteristic USING btree (name, nominal, lower, upper, unit, decimals, tool);


--
-- Name: chunk_digest; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX chunk_digest ON public.chunk USING btree (id, sha256);


--
-- Name: content_chunk_by_chunk; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX content_chunk_by_chunk ON public.content_chunk USING btree (chunk);


--
-- Name: folder_file_by_folder; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX folder_file_by_folder ON public.folder_file USING btree (folder, state);


--
-- Name: folder_file_unfinished; Type: INDEX; Schema: public; Owner: -
--

CREATE UNIQUE INDEX folder_file_unfinished ON public.folder_file USING btree (folder, name) WHERE (moved_us IS NULL);


--
-- Name: import_decided; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX import_decided ON public.import USING btree (decided_us) WHERE (state <> 'pending'::text);


--
-- Name: import_pending; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX import_pending ON public.import USING btree (program, revision) WHERE (state = 'pending'::text);


--
-- Name: job_by_machine; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX job_by_machine ON public.job USING btree (machine, "position");


--
-- Name: measured_part_by_machine; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX measured_part_by_machine ON public.measured_part USING btree (machine, begun_us);


--
-- Name: measured_part_by_run; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX measured_part_by_run ON public.measured_part USING btree (run) WHERE (run IS NOT NULL);


--
-- Name: measurement_by_characteristic; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX measurement_by_characteristic ON public.measurement USING btree (machine, name, time_us);


--
-- Name: measurement_by_part; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX measurement_by_part ON public.measurement USING btree (part);


--
-- Name: measurement_by_record; Type: INDEX; Schema: public; Owner: -
--

CREATE UNIQUE INDEX measurement_by_record ON public.measurement USING btree (machine, epoch, number, item) WHERE (is_superseded = 0);


--
-- Name: measurement_by_time; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX measurement_by_time ON public.measurement USING btree (machine, time_us);


--
-- Name: measurement_outside; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX measurement_outside ON public.measurement USING btree (machine, time_us) WHERE (verdict >= 2);


--
-- Name: offset_proposal_by_machine; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX offset_proposal_by_machine ON public.offset_proposal USING btree (machine, id);


--
-- Name: offset_proposal_by_setup; Type: INDEX; Schema: public; Owner: -
--

CREATE UNIQUE INDEX offset_proposal_by_setup ON public.offset_proposal USING btree (machine, setup) WHERE (setup IS NOT NULL);


--
-- Name: offset_proposal_pending; Type: INDEX; Schema: public; Owner: -
--

CREATE UNIQUE INDEX offset_proposal_pending ON public.offset_proposal USING btree (machine, target) WHERE (state = 'pending'::text);


--
-- Name: program_by_author; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX program_by_author ON public.program USING btree (latest_author, name) WHERE (latest IS NOT NULL);


--
-- Name: program_by_control; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX program_by_control ON public.program USING btree (latest_control, name) WHERE (latest IS NOT NULL);


--
-- Name: program_by_group; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX program_by_group ON public.program USING btree (machine_group, name) WHERE (latest IS NOT NULL);


--
-- Name: program_by_material; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX program_by_material ON public.program USING btree (material, name) WHERE (latest IS NOT NULL);


--
-- Name: program_by_operation; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX program_by_operation ON public.program USING btree (operation, name) WHERE (latest IS NOT NULL);


--
-- Name: program_by_part; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX program_by_part ON public.program USING btree (part, name) WHERE (latest IS NOT NULL);


--
-- Name: program_by_state; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX program_by_state ON public.program USING btree (latest_state, name) WHERE (latest IS NOT NULL);


--
-- Name: program_listed; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX program_listed ON public.program USING btree (name) WHERE (latest IS NOT NULL);


--
-- Name: record_by_run; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX record_by_run ON public.record USING btree (run, epoch, number) WHERE (run IS NOT NULL);


--
-- Name: record_of_memory; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX record_of_memory ON public.record USING btree (machine, epoch, number) WHERE ((kind = 'message'::text) AND (device = 'memory'::text));


--
-- Name: record_without_run; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX record_without_run ON public.record USING btree (machine, epoch, number) WHERE ((run IS NULL) AND (kind = ANY (ARRAY['output'::text, 'probe'::text])));


--
-- Name: report_finding_by_machine; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX report_finding_by_machine ON public.report_finding USING btree (machine, time_us);


--
-- Name: report_finding_by_part; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX report_finding_by_part ON public.report_finding USING btree (part) WHERE (part IS NOT NULL);


--
-- Name: report_finding_by_run; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX report_finding_by_run ON public.report_finding USING btree (run) WHERE (run IS NOT NULL);


--
-- Name: revision_by_content; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX revision_by_content ON public.revision USING btree (content);


--
-- Name: revision_by_digest; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX revision_by_digest ON public.revision USING btree (sha256);


--
-- Name: revision_pin_by_revision; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX revision_pin_by_revision ON public.revision_pin USING btree (program, revision);


--
-- Name: revision_step_by_revision; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX revision_step_by_revision ON public.revision_step USING btree (program, revision, id);


--
-- Name: run_by_job; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX run_by_job ON public.run USING btree (job, state) WHERE (job IS NOT NULL);


--
-- Name: run_by_machine; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX run_by_machine ON public.run USING btree (machine);


--
-- Name: run_by_program; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX run_by_program ON public.run USING btree (program, revision);


--
-- Name: run_by_setup; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX run_by_setup ON public.run USING btree (machine, setup) WHERE (setup IS NOT NULL);


--
-- Name: run_unfinished; Type: INDEX; Schema: public; Owner: -
--

CREATE UNIQUE INDEX run_unfinished ON public.run USING btree (machine) WHERE (state = ANY (ARRAY['ordered'::text, 'active'::text]));


--
-- Name: search_index_words; Type: INDEX; Schema: public; Owner: -
--

CREATE INDEX search_index_words ON public.search_index USING gin (words);


--
-- Name: attachment attachment_changed; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER attachment_changed AFTER INSERT OR DELETE ON public.attachment FOR EACH ROW EXECUTE FUNCTION public.on_attachment();


--
-- Name: record event_of_alarm; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_alarm AFTER INSERT ON public.record FOR EACH ROW WHEN ((new.kind = 'alarm'::text)) EXECUTE FUNCTION public.event_of_alarm();


--
-- Name: measured_part event_of_good_part; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_good_part AFTER UPDATE OF verdict, ended_us ON public.measured_part FOR EACH ROW WHEN (((new.verdict = 0) AND (new.ended_us IS NOT NULL) AND (old.ended_us IS NULL) AND (new.run IS NOT NULL))) EXECUTE FUNCTION public.event_of_good_part();


--
-- Name: import event_of_import_state; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_import_state AFTER UPDATE OF state ON public.import FOR EACH ROW WHEN ((new.state <> old.state)) EXECUTE FUNCTION public.event_of_import();


--
-- Name: job_hold event_of_job_hold; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_job_hold AFTER INSERT OR DELETE ON public.job_hold FOR EACH ROW EXECUTE FUNCTION public.event_of_job_hold();


--
-- Name: run event_of_job_progress; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_job_progress AFTER UPDATE OF state ON public.run FOR EACH ROW WHEN (((new.job IS NOT NULL) AND (new.state = 'completed'::text) AND (old.state <> 'completed'::text))) EXECUTE FUNCTION public.event_of_job_progress();


--
-- Name: measured_part event_of_new_good_part; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_new_good_part AFTER INSERT ON public.measured_part FOR EACH ROW WHEN (((new.verdict = 0) AND (new.ended_us IS NOT NULL) AND (new.run IS NOT NULL))) EXECUTE FUNCTION public.event_of_good_part();


--
-- Name: import event_of_new_import; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_new_import AFTER INSERT ON public.import FOR EACH ROW EXECUTE FUNCTION public.event_of_import();


--
-- Name: job event_of_new_job; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_new_job AFTER INSERT ON public.job FOR EACH ROW EXECUTE FUNCTION public.event_of_new_job();


--
-- Name: measured_part event_of_new_part; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_new_part AFTER INSERT ON public.measured_part FOR EACH ROW WHEN (((new.verdict >= 2) OR (new.ended_us IS NOT NULL))) EXECUTE FUNCTION public.event_of_part();


--
-- Name: revision event_of_new_revision; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_new_revision AFTER INSERT ON public.revision FOR EACH ROW EXECUTE FUNCTION public.event_of_new_revision();


--
-- Name: run event_of_new_run; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_new_run AFTER INSERT ON public.run FOR EACH ROW EXECUTE FUNCTION public.event_of_run();


--
-- Name: job event_of_removed_job; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_removed_job AFTER UPDATE OF removed_us ON public.job FOR EACH ROW WHEN (((new.removed_us IS NOT NULL) AND (old.removed_us IS NULL))) EXECUTE FUNCTION public.event_of_removed_job();


--
-- Name: revision event_of_revision_state; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_revision_state AFTER UPDATE OF state ON public.revision FOR EACH ROW WHEN ((new.state <> old.state)) EXECUTE FUNCTION public.event_of_revision_state();


--
-- Name: run event_of_run_state; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_run_state AFTER UPDATE OF state ON public.run FOR EACH ROW WHEN ((new.state <> old.state)) EXECUTE FUNCTION public.event_of_run();


--
-- Name: measured_part event_of_verdict; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER event_of_verdict AFTER UPDATE OF verdict, ended_us ON public.measured_part FOR EACH ROW WHEN ((((new.verdict >= 2) AND (new.verdict <> old.verdict)) OR ((new.verdict < 2) AND (new.ended_us IS NOT NULL) AND (old.ended_us IS NULL)))) EXECUTE FUNCTION public.event_of_part();


--
-- Name: program program_described; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER program_described AFTER UPDATE OF name, part, operation, material, machine_group ON public.program FOR EACH ROW EXECUTE FUNCTION public.on_program_described();


--
-- Name: program program_removed; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER program_removed AFTER UPDATE OF removed_through ON public.program FOR EACH ROW EXECUTE FUNCTION public.on_program_removed();


--
-- Name: revision revision_added; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER revision_added AFTER INSERT ON public.revision FOR EACH ROW EXECUTE FUNCTION public.on_revision();


--
-- Name: revision revision_changed; Type: TRIGGER; Schema: public; Owner: -
--

CREATE TRIGGER revision_changed AFTER UPDATE OF standing, state, cam_file ON public.revision FOR EACH ROW EXECUTE FUNCTION public.on_revision();


--
-- Name: archived_part archived_part_archive_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.archived_part
    ADD CONSTRAINT archived_part_archive_fkey FOREIGN KEY (archive) REFERENCES public.archive(id);


--
-- Name: attachment attachment_content_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.attachment
    ADD CONSTRAINT attachment_content_fkey FOREIGN KEY (content) REFERENCES public.content(id);


--
-- Name: attachment attachment_program_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.attachment
    ADD CONSTRAINT attachment_program_fkey FOREIGN KEY (program) REFERENCES public.program(id);


--
-- Name: attachment attachment_program_revision_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.attachment
    ADD CONSTRAINT attachment_program_revision_fkey FOREIGN KEY (program, revision) REFERENCES public.revision(program, number);


--
-- Name: characteristic characteristic_name_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.characteristic
    ADD CONSTRAINT characteristic_name_fkey FOREIGN KEY (name) REFERENCES public.characteristic_name(id);


--
-- Name: content_chunk content_chunk_chunk_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.content_chunk
    ADD CONSTRAINT content_chunk_chunk_fkey FOREIGN KEY (chunk) REFERENCES public.chunk(id);


--
-- Name: content_chunk content_chunk_content_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.content_chunk
    ADD CONSTRAINT content_chunk_content_fkey FOREIGN KEY (content) REFERENCES public.content(id);


--
-- Name: credential_group credential_group_machine_group_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.credential_group
    ADD CONSTRAINT credential_group_machine_group_fkey FOREIGN KEY (machine_group) REFERENCES public.machine_group(name);


--
-- Name: credential_group credential_group_user_name_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.credential_group
    ADD CONSTRAINT credential_group_user_name_fkey FOREIGN KEY ("user", name) REFERENCES public.credential("user", name) ON DELETE CASCADE;


--
-- Name: credential credential_user_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.credential
    ADD CONSTRAINT credential_user_fkey FOREIGN KEY ("user") REFERENCES public."user"(name);


--
-- Name: import import_program_revision_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.import
    ADD CONSTRAINT import_program_revision_fkey FOREIGN KEY (program, revision) REFERENCES public.revision(program, number);


--
-- Name: job_hold job_hold_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.job_hold
    ADD CONSTRAINT job_hold_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: job job_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.job
    ADD CONSTRAINT job_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: job job_program_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.job
    ADD CONSTRAINT job_program_fkey FOREIGN KEY (program) REFERENCES public.program(id);


--
-- Name: loaded_setup loaded_setup_machine_number_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.loaded_setup
    ADD CONSTRAINT loaded_setup_machine_number_fkey FOREIGN KEY (machine, number) REFERENCES public.setup(machine, number);


--
-- Name: machine_group_member machine_group_member_machine_group_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.machine_group_member
    ADD CONSTRAINT machine_group_member_machine_group_fkey FOREIGN KEY (machine_group) REFERENCES public.machine_group(name) ON DELETE CASCADE;


--
-- Name: machine_hold machine_hold_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.machine_hold
    ADD CONSTRAINT machine_hold_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: measured_part measured_part_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.measured_part
    ADD CONSTRAINT measured_part_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: measured_part measured_part_template_version_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.measured_part
    ADD CONSTRAINT measured_part_template_version_fkey FOREIGN KEY (template, version) REFERENCES public.report_template(name, version);


--
-- Name: measurement measurement_characteristic_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.measurement
    ADD CONSTRAINT measurement_characteristic_fkey FOREIGN KEY (characteristic) REFERENCES public.characteristic(id);


--
-- Name: measurement_cursor measurement_cursor_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.measurement_cursor
    ADD CONSTRAINT measurement_cursor_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: measurement measurement_part_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.measurement
    ADD CONSTRAINT measurement_part_fkey FOREIGN KEY (part) REFERENCES public.measured_part(id);


--
-- Name: measurement_state measurement_state_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.measurement_state
    ADD CONSTRAINT measurement_state_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: port_setting port_setting_port_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.port_setting
    ADD CONSTRAINT port_setting_port_fkey FOREIGN KEY (port) REFERENCES public.port(name) ON DELETE CASCADE;


--
-- Name: port_transfer port_transfer_port_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.port_transfer
    ADD CONSTRAINT port_transfer_port_fkey FOREIGN KEY (port) REFERENCES public.port(name) ON DELETE CASCADE;


--
-- Name: record_cursor record_cursor_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.record_cursor
    ADD CONSTRAINT record_cursor_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: record_cursor record_cursor_reader_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.record_cursor
    ADD CONSTRAINT record_cursor_reader_fkey FOREIGN KEY (reader) REFERENCES public.record_reader(name);


--
-- Name: record_epoch record_epoch_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.record_epoch
    ADD CONSTRAINT record_epoch_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: record record_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.record
    ADD CONSTRAINT record_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: report_finding report_finding_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.report_finding
    ADD CONSTRAINT report_finding_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: report_finding report_finding_part_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.report_finding
    ADD CONSTRAINT report_finding_part_fkey FOREIGN KEY (part) REFERENCES public.measured_part(id);


--
-- Name: revision revision_content_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.revision
    ADD CONSTRAINT revision_content_fkey FOREIGN KEY (content) REFERENCES public.content(id);


--
-- Name: revision_pin revision_pin_program_revision_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.revision_pin
    ADD CONSTRAINT revision_pin_program_revision_fkey FOREIGN KEY (program, revision) REFERENCES public.revision(program, number);


--
-- Name: revision_pin revision_pin_step_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.revision_pin
    ADD CONSTRAINT revision_pin_step_fkey FOREIGN KEY (step) REFERENCES public.revision_step(id);


--
-- Name: revision revision_program_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.revision
    ADD CONSTRAINT revision_program_fkey FOREIGN KEY (program) REFERENCES public.program(id);


--
-- Name: revision_step revision_step_program_revision_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.revision_step
    ADD CONSTRAINT revision_step_program_revision_fkey FOREIGN KEY (program, revision) REFERENCES public.revision(program, number);


--
-- Name: run run_approval_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.run
    ADD CONSTRAINT run_approval_fkey FOREIGN KEY (approval) REFERENCES public.revision_step(id);


--
-- Name: run_call run_call_program_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.run_call
    ADD CONSTRAINT run_call_program_fkey FOREIGN KEY (program) REFERENCES public.program(id);


--
-- Name: run_call run_call_run_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.run_call
    ADD CONSTRAINT run_call_run_fkey FOREIGN KEY (run) REFERENCES public.run(number);


--
-- Name: run run_job_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.run
    ADD CONSTRAINT run_job_fkey FOREIGN KEY (job) REFERENCES public.job(id);


--
-- Name: run run_machine_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.run
    ADD CONSTRAINT run_machine_fkey FOREIGN KEY (machine) REFERENCES public.machine(id);


--
-- Name: run run_program_revision_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.run
    ADD CONSTRAINT run_program_revision_fkey FOREIGN KEY (program, revision) REFERENCES public.revision(program, number);


--
-- Name: search_due search_due_program_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.search_due
    ADD CONSTRAINT search_due_program_fkey FOREIGN KEY (program) REFERENCES public.program(id);


--
-- Name: upload upload_content_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.upload
    ADD CONSTRAINT upload_content_fkey FOREIGN KEY (content) REFERENCES public.content(id);


--
-- Name: user_group user_group_machine_group_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.user_group
    ADD CONSTRAINT user_group_machine_group_fkey FOREIGN KEY (machine_group) REFERENCES public.machine_group(name);


--
-- Name: user_group user_group_user_fkey; Type: FK CONSTRAINT; Schema: public; Owner: -
--

ALTER TABLE ONLY public.user_group
    ADD CONSTRAINT user_group_user_fkey FOREIGN KEY ("user") REFERENCES public."user"(name);


--
-- PostgreSQL database dump complete
--


INSERT INTO public.store_holder (id, holder, described, until) VALUES (1, '', '', now());
