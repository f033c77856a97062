-- Version 11: what a run may call does not depend on the clock.

-- The number of the newest run, of all machines, when the revision came into force, was released and was withdrawn; 0: there was none. NULL: not
-- yet, or it was before version 11, and so before every run that begins.
ALTER TABLE revision ADD COLUMN in_force_after bigint;
ALTER TABLE revision ADD COLUMN released_after bigint;
ALTER TABLE revision ADD COLUMN withdrawn_after bigint;
