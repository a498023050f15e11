//! Active contacts under changing loads: change of forces with a response, and the contacts that close next.

use super::super::place::CandidatePair;
use super::super::{CLOSED, StaticContacts};
use super::{Programme, Response, TOUCHING};

impl StaticContacts {
    /// Changes of forces that a programme has found.
    pub(super) fn take(&mut self, programme: &Programme) {
        self.places.iter_mut().filter(|p| p.is_exact).for_each(|p| p.change = 0.0);
        for (k, i) in programme.places.iter().enumerate() {
            let place = &mut self.places[*i];
            place.change = programme.multipliers[k] - place.multiplier;
        }
    }

    /// Begins a correction that changes no force of a rigid contact yet.
    pub fn keep_forces(&mut self) {
        self.places.iter_mut().filter(|p| p.is_exact).for_each(|p| p.change = 0.0);
    }

    /// Which contacts press, by place; of rigid ones those whose forces corrections find.
    pub fn pressing(&self) -> Vec<bool> {
        self.places.iter().map(CandidatePair::presses).collect()
    }

    /// Rate, in a response, at which contacts that have closed since press more, or contacts that have opened since separate; `None` if the active
    /// contacts are the same.
    pub fn onward(&self, since: &[bool], response: &Response) -> Option<f64> {
        let now = self.pressing();
        let moved = |i: usize| self.places[i].row.on(&response.nodal);
        let closed = |i: &usize| now[*i] && !since[*i];
        if (0..now.len()).any(|i| closed(&i)) {
            let rigid = response.contacts.iter().filter(|(i, _)| closed(i));
            let rigid: f64 = rigid.map(|(_, force)| force).sum();
            let compliant = (0..now.len()).filter(|i| closed(i) && self.places[*i].is_compliant());
            return Some(rigid - compliant.map(|i| self.places[i].slope * moved(i)).sum::<f64>());
        }
        let opened = (0..now.len()).filter(|i| !now[*i] && since[*i]);
        let mut gone = opened.map(moved).peekable();
        gone.peek()?;
        Some(gone.sum())
    }

    /// The open contact that closes first as the load factor changes in the direction `rise`, from the response to it.
    pub fn next_to_close(&self, response: &Response, rise: f64) -> Option<usize> {
        let followed = |p: &CandidatePair| p.is_exact || p.is_compliant();
        let open = |p: &CandidatePair| followed(p) && !p.presses() && p.gap.is_finite();
        let closing = |(i, p): (usize, &CandidatePair)| {
            let rate = -rise.signum() * p.row.on(&response.nodal);
            (rate > 0.0).then_some((i, p.gap.max(0.0) / rate))
        };
        let all = self.places.iter().enumerate().filter(|(_, p)| open(p)).filter_map(closing);
        all.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
    }

    /// The gap at which a contact counts as just touching: a compliant one presses there a little, and gives way no more.
    pub fn touching(&self, place: usize) -> f64 {
        if self.places[place].is_compliant() { -TOUCHING * self.size } else { 0.0 }
    }

    /// The gap that a correction leads a contact to, and how it changes in a response.
    pub fn gap_after(
        &self,
        place: usize,
        correction: &[[f64; 4]],
        response: &Response,
    ) -> [f64; 2] {
        let place = &self.places[place];
        [place.gap + place.row.on(correction), place.row.on(&response.nodal)]
    }

    /// The open contact that is furthest inside, if any is.
    pub fn innermost(&self) -> Option<usize> {
        let inside = |(_, p): &(usize, &CandidatePair)| p.is_exact && p.gap < -CLOSED * self.size;
        let all = self.places.iter().enumerate().filter(inside);
        all.min_by(|a, b| a.1.gap.total_cmp(&b.1.gap)).map(|(i, _)| i)
    }

    /// A touching contact is active from now on.
    pub fn close(&mut self, place: usize) {
        if !self.places[place].is_compliant() {
            self.places[place].multiplier = f64::MIN_POSITIVE;
        }
    }

    /// Adds a share of the forces of a response to the changes of a correction.
    pub fn respond(&mut self, response: &Response, share: f64) {
        for (i, force) in &response.contacts {
            self.places[*i].change += share * force;
        }
    }
}
