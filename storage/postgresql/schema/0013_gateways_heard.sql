-- Version 13: servers that wait say how many gateways they hear, and hand-overs that no person asked for are counted.

ALTER TABLE store_standby ADD COLUMN gateways bigint CHECK (gateways >= 0);  -- that it hears; NULL: not known

-- One soon after the other, by servers that heard no gateway any more; 0 again when a person hands over, or one of them has heard gateways for long.
ALTER TABLE store_holder ADD COLUMN own_hand_overs bigint NOT NULL DEFAULT 0 CHECK (own_hand_overs >= 0);
ALTER TABLE store_holder ADD COLUMN has_helped integer NOT NULL DEFAULT 1 CHECK (has_helped IN (0, 1));  -- a gateway was heard after the last of them
