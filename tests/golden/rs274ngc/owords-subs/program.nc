G21
o1 sub
#<twice>=[#1*2]
o5 if [#2 gt 0]
o1 return [#<twice>]
o5 endif
G0 X#1
o1 endsub [7]
o<move it> sub
o1 call [#1] [#2]
G0 Y#<_value>
o<moveit> endsub
#1=50
o<move it> call [3]
o<MOVE IT> call [4] [1]
G0 Z#1
M2
