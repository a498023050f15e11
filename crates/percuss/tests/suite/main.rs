//! All integration tests of the crate in one program: linking one for each file took gigabytes and minutes.

mod audit;
mod beam_ends;
mod common;
mod contact;
mod contact_resultant;
mod crowds;
mod driven;
mod ensembles;
mod frames;
mod hard_impacts;
mod impact_log;
mod impacts;
mod initial_motions;
mod joints;
mod layers;
mod multiple_impacts;
mod schemes;
mod section_forces;
mod sensitivities;
mod spectra;
mod static_contact;
mod static_contact_stretches;
mod static_paths;
mod statics;
mod structures;
mod structures_in_motion;
