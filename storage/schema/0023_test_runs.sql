-- Version 23: a run that was ordered as a test run is known as one however it ends.

-- 0 of runs before: those that found nothing ended as tested.
ALTER TABLE run ADD COLUMN is_test INTEGER NOT NULL DEFAULT 0 CHECK (is_test IN (0, 1));
