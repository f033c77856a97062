-- Version 10: whether a run or a program without a run passed a line last does not depend on the clock.

-- The id of the newest run of the port's machine when it began, empty: there was none. NULL of those before: their times decide.
ALTER TABLE port_transfer ADD COLUMN after_run text COLLATE "C";
