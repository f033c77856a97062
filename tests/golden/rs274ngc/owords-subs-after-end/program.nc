G20
o1 repeat [2]
G0 X1
o1 endrepeat
o2 call
o<corner> call [3]
o<corner> call [4]
M2
o2 sub
G0 Z1
o2 endsub
o<corner> sub
G0 X#1
o3 call
o5 if [#1 gt 3]
o2 call
o<corner> return
o5 endif
G0 Y#1
o<corner> endsub
o3 sub
G0 Z[#1+5]
o3 endsub
