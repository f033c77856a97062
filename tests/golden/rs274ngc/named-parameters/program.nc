#<a b>=3 #<_all>=[EXISTS[#<ab>]+4]
G0 X#<AB> Y#<_all>
G21 Z[#<_metric>+#<_x>]
X#<_call_level> Y[#<_motion_mode>]
M2
