-- Version 8: programs that go to a control, or come from it, without a run are known to the server that begins or takes over after a kill;
-- servers that wait see how the settings of the one that has the place differ from theirs.

-- The latest of each direction; what was before is in the audit trail.
CREATE TABLE port_transfer (
  port text COLLATE "C" NOT NULL REFERENCES port (name) ON DELETE CASCADE,
  direction text COLLATE "C" NOT NULL CHECK (direction IN ('send', 'receive')),
  id text COLLATE "C" NOT NULL,
  programs text COLLATE "C" NOT NULL,  -- one a line, as people read them; what is received may have no name yet
  size bigint NOT NULL CHECK (size >= 0),      -- bytes; 0 while it is not known
  passed bigint NOT NULL CHECK (passed >= 0),  -- bytes that have passed the line for certain
  at_most bigint NOT NULL CHECK (at_most >= 0),  -- bytes that may have passed it: stored before they leave
  state text COLLATE "C" NOT NULL CHECK (state IN ('active', 'completed', 'aborted', 'interrupted')),
  reason text COLLATE "C" NOT NULL,  -- why it was not completed, for people
  began_us bigint NOT NULL,
  ended_us bigint,                   -- NULL while it is active
  PRIMARY KEY (port, direction),
  CHECK ((state = 'active') = (ended_us IS NULL))
);

-- Of the server that had the place last: what those that wait are to have alike, as the server writes it.
ALTER TABLE store_holder ADD COLUMN settings text COLLATE "C" NOT NULL DEFAULT '';
