-- Version 26: machines can be removed; what refers to them stays.

ALTER TABLE machine ADD COLUMN removed_us INTEGER;  -- NULL: it is listed
