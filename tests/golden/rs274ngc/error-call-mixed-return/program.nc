(expect NGC0304 5:0)
o1 call
M2
o1 sub
M99
o1 endsub
