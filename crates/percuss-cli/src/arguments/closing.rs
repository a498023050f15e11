//! What stands below the options in the help of a command: exit status, remarks, examples.

pub(super) const EXIT_STATUS: &str = "\
Exit status:
  0    done
  1    the system refused (disk full, no permission)
  2    the input is wrong; nothing is written
  3    the solver gave up; everything up to the last step is written
  4    the balances did not close (--strict)
  130  interrupted; everything up to the last step is written";

pub(super) const BEGIN: &str = "\
To begin:
  percuss new elastic --out my.toml
  percuss run my.toml
and open runs/my/report.html in a browser.";

pub(super) const STATIC: &str = "\
Prints the largest displacement, displacements and rotations of the recorded points, reactions of
the supports (on the structure, signed), smallest and largest section forces of every beam, and the
factor at which the loads buckle the linearised structure, if they do.

With --path all loads grow with one factor, and the path is followed by arc length: past limit
points, where a search in load steps ends. Where it begins and ends is set by [path] in the scenario;
without it the path ends at the factor 1. Prescribed motions take no part in it.

Examples:
  percuss static frame.toml
  percuss static frame.toml --set load.roof.force=\"[0, -20e3]\" --json | jq .support
  percuss static arch.toml --path --out results/arch
  percuss static arch.toml --path --set path.factor=2";

pub(super) const SENSITIVITY: &str = "\
Every operation of the run is differentiated, the instants of impacts included (forward mode): the derivatives are those of \
the computed run, not differences of runs. Beams and frames struck by guided projectiles can be differentiated, on fixed supports, \
springs to the ground and before stops, with rigid joints and hinges, by the energy-momentum scheme, with damping of the material and dead loads that do not change in time.";

pub(super) const CONVERGE: &str = "\
The run is repeated with halved steps on the given mesh, and with doubled elements under the given step. The limit is Richardson's
extrapolation in both; where values do not close in on one steadily no order is told, and the uncertainty is what they still move.
Files are not written.

Examples:
  percuss converge plank.toml
  percuss converge plank.toml --accuracy \"1 %\" --result contact.mass.peak_force.value
  percuss converge plank.toml --levels 5 --json | jq '.results[].limit'";

pub(super) const MODES: &str = "\
A frequency of zero is a motion of a rigid body or of a mechanism. About a static equilibrium stresses
count; a mode that grows says that the equilibrium is unstable.

Examples:
  percuss modes frame.toml
  percuss modes frame.toml --count 20 --about static --out results/modes
  percuss modes frame.toml --json | jq '.modes[].frequency'";

pub(super) const SWEEP: &str = "\
A run that fails is a row with the reason. Every run follows from the study and its own number alone, so
the same study gives the same results.parquet on any number of threads.

Ctrl-C ends the sweep after the runs under way; a second one ends it at once. Interrupted or killed, here or
moved to another machine, the same command goes on where it was.

Examples:
  percuss sweep fragility.toml
  percuss sweep fragility.toml --out /scratch/fragility --jobs 16
  percuss sweep fragility.toml --shard $SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT";

pub(super) const VERIFY: &str = "\
Exit status: 0 if every case holds, 3 if one does not, 2 for an unknown case.

Examples:
  percuss verify
  percuss verify rigid-rod bouncing-ball --all-checks";

pub(super) const EXPORT: &str = "\
Open all files together in ParaView, colour beams by stress or moment, and put a Glyph filter on contacts (orientation and scale:
force or impulse). All numbers are SI.

Examples:
  percuss export runs/plank
  percuss export runs/plank --format pvd --out plank-paraview";

pub(super) const COMPLETIONS: &str = "\
Examples:
  percuss completions bash > ~/.local/share/bash-completion/completions/percuss
  percuss completions fish > ~/.config/fish/completions/percuss.fish";
