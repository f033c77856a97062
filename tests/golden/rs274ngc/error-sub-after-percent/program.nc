%
(a comment)
o1 call
M2
(the tape ends before the sub)
%
o1 sub
o1 endsub
