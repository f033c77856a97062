G21
#1=0
o1 while [#1 lt 9]
#1=[#1+1]
o2 if [#1 eq 3]
o1 continue
o2 elseif [#1 gt 4]
o1 break
o2 endif
G0 X#1
o1 endwhile
o3 do
#1=[#1-2]
G0 Y#1
o3 while [#1 gt 0]
o4 repeat [2.4]
G91 G0 Z1
o4 endrepeat
M2
