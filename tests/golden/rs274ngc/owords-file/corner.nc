%
(a corner)
o<corner> sub
G0 X#1
G0 Y#2
o<corner> endsub
G0 X99
%
