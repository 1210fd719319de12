"""One file a start set of arms: a constant STARTS of type tasks.base.ArmStartSet, named as the file with dashes.

Every start says where the joints are, how the tool is oriented there by MuJoCo's forward kinematics, and the goal;
the tool's position is to be held. `clear` keeps away from all that an arm or a representation can be blamed for;
`wrist`, `pole` and `half-turn` are directed at one trouble each; `uniform` and `tumbling` are sampled; `reach` alone
commands a motion of the position too. They are made for any arm from its model alone, by search, so that an arm file
that is dropped in has them too; one that cannot do as many has fewer.
"""
