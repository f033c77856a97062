-- Version 4 in PostgreSQL: what listings show and choose by, kept by triggers whatever changes a revision; and what the search index is due.

CREATE FUNCTION note_due(bigint) RETURNS void LANGUAGE sql
  AS 'INSERT INTO search_due (program) VALUES ($1) ON CONFLICT (program) DO UPDATE SET version = search_due.version + 1';

CREATE FUNCTION list_again(changed bigint) RETURNS void LANGUAGE plpgsql AS $$
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

CREATE FUNCTION on_revision() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  PERFORM list_again(NEW.program);
  RETURN NULL;
END $$;
CREATE TRIGGER revision_added AFTER INSERT ON revision FOR EACH ROW EXECUTE FUNCTION on_revision();
CREATE TRIGGER revision_changed AFTER UPDATE OF standing, state, cam_file ON revision FOR EACH ROW EXECUTE FUNCTION on_revision();

CREATE FUNCTION on_program_removed() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  -- A program that is pushed again under the name begins without them.
  UPDATE program SET part = '', operation = '', material = '', machine_group = '' WHERE id = NEW.id;
  UPDATE attachment SET revision = NEW.removed_through WHERE program = NEW.id AND revision IS NULL AND NOT EXISTS (
    SELECT 1 FROM attachment AS other WHERE other.program = NEW.id AND other.revision = NEW.removed_through AND other.name = attachment.name);
  DELETE FROM attachment WHERE program = NEW.id AND revision IS NULL;
  PERFORM list_again(NEW.id);
  RETURN NULL;
END $$;
CREATE TRIGGER program_removed AFTER UPDATE OF removed_through ON program FOR EACH ROW EXECUTE FUNCTION on_program_removed();

CREATE FUNCTION on_program_described() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  PERFORM note_due(NEW.id);
  RETURN NULL;
END $$;
CREATE TRIGGER program_described AFTER UPDATE OF name, part, operation, material, machine_group ON program
  FOR EACH ROW EXECUTE FUNCTION on_program_described();

CREATE FUNCTION on_attachment() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  PERFORM note_due(CASE TG_OP WHEN 'DELETE' THEN OLD.program ELSE NEW.program END);
  RETURN NULL;
END $$;
CREATE TRIGGER attachment_changed AFTER INSERT OR DELETE ON attachment FOR EACH ROW EXECUTE FUNCTION on_attachment();
