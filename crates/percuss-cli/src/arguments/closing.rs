//! Text below the options in the help of a command: exit status, remarks, examples. Paragraphs have no line breaks: clap wraps them.

pub(super) const EXIT_STATUS: &str = "\
Exit status:
  0    done
  1    I/O error (disk full, no permission)
  2    invalid input; nothing is written
  3    no convergence; results up to the last step are written
  4    balance error above the limit (--strict), or a denied warning
  130  interrupted; results up to the last step are written";

pub(super) const BEGIN: &str = "\
To begin:
  percuss new elastic --out my.toml
  percuss run my.toml
and open runs/my/report.html in a browser.";

pub(super) const BOOK: &str = "\
Archives and wheels of a release contain the book; in the sources of Percuss `scripts/book` builds it. It is searched in PERCUSS_BOOK, if \
that is set, otherwise in book/ beside the program and in share/percuss/book/ below its prefix.

Examples:
  percuss book
  percuss book --path";

pub(super) const STATIC: &str = "\
Prints the largest displacement, displacements and rotations of the recorded points, reactions of the supports (on the structure, signed), smallest and largest section \
forces of every beam, and the linear buckling factor.

With --path all loads grow with one factor, and the equilibrium path is followed by arc length, past limit points. [path] in the \
scenario sets its start and end; the default end is load factor 1. Prescribed motions are ignored.

Examples:
  percuss static frame.toml
  percuss static frame.toml --set load.roof.force=\"[0, -20e3]\" --json | jq .support
  percuss static arch.toml --path --out results/arch
  percuss static arch.toml --path --set path.factor=2";

pub(super) const SENSITIVITY: &str = "\
Derivatives of the computed run by forward-mode automatic differentiation, instants of impacts included; no difference quotients. \
Supported: beams and frames struck by guided projectiles, on fixed supports, springs to ground and stops, with rigid joints and hinges, \
under the energy-momentum scheme, with material damping and dead loads that are constant in time.";

pub(super) const CONVERGE: &str = "\
The run is repeated with halved steps on the given mesh, and with doubled elements at the given step. The limit is the Richardson \
extrapolation in both; where values do not converge monotonically no order is given and the uncertainty is the last change. No files are \
written.

Examples:
  percuss converge plank.toml
  percuss converge plank.toml --accuracy \"1 %\" --result contact.mass.peak_force.value
  percuss converge plank.toml --levels 5 --json | jq '.results[].limit'";

pub(super) const MODES: &str = "\
A mode of zero frequency is a rigid-body mode or a mechanism. About a static equilibrium the geometric stiffness is included; a \
growing mode means that the equilibrium is unstable.

Examples:
  percuss modes frame.toml
  percuss modes frame.toml --count 20 --about static --out results/modes
  percuss modes frame.toml --json | jq '.modes[].frequency'";

pub(super) const SWEEP: &str = "\
A failed run is a row with the reason. Results do not depend on the number of threads.

Ctrl-C stops the sweep after the current runs; a second Ctrl-C stops it immediately. After an interruption the same command \
continues, also on another machine.

Examples:
  percuss sweep fragility.toml
  percuss sweep fragility.toml --out /scratch/fragility --jobs 16
  percuss sweep fragility.toml --shard $SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT";

pub(super) const VERIFY: &str = "\
Exit status: 0 if all cases pass, 3 if one fails, 2 for an unknown case.

Examples:
  percuss verify
  percuss verify rigid-rod bouncing-ball --all-checks";

pub(super) const EXPORT: &str = "\
Open all files together in ParaView, colour beams by stress or moment, and apply a Glyph filter to contacts (orientation and scale: \
force or impulse). All values are in SI units.

Examples:
  percuss export runs/plank
  percuss export runs/plank --format pvd --out plank-paraview";

pub(super) const COMPLETIONS: &str = "\
Examples:
  percuss completions bash > ~/.local/share/bash-completion/completions/percuss
  percuss completions fish > ~/.config/fish/completions/percuss.fish";
