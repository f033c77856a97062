-- Version 12: machines can be removed; what refers to them stays.

ALTER TABLE machine ADD COLUMN removed_us bigint;  -- NULL: it is listed
