//! Batches of rays, cut into beams where the rays have something in common.

use arrayvec::ArrayVec;

use super::frustum::PACKETS;
use super::lanes::{LANES, Lanes};
use super::packet::Packet;
use super::stack::Stack;
use super::walk::Start;
use super::{Accel, Hit};
use crate::geometry::Ray;

/// What a batch is asked for.
pub trait Answer: Sized {
    /// Whether any hit of a ray answers for it, not only the closest.
    const ANY: bool;
    /// The answers of a packet that was traced.
    fn of_packet<L: Lanes>(accel: &Accel, packet: &Packet<L>, answers: &mut [Self; LANES]);
    /// The answer of a ray by itself.
    fn of_one(accel: &Accel, stack: &mut Stack, ray: &Ray) -> Self;
}

impl Answer for Hit {
    const ANY: bool = false;

    #[inline(always)]
    fn of_packet<L: Lanes>(accel: &Accel, packet: &Packet<L>, answers: &mut [Self; LANES]) {
        packet.hits(accel, answers);
    }

    #[inline(always)]
    fn of_one(accel: &Accel, stack: &mut Stack, ray: &Ray) -> Self {
        accel.hit(accel.closest_of_one(stack, ray, Start::ROOT))
    }
}

impl Answer for bool {
    const ANY: bool = true;

    #[inline(always)]
    fn of_packet<L: Lanes>(_: &Accel, packet: &Packet<L>, answers: &mut [Self; LANES]) {
        let met = packet.met();
        for (i, answer) in answers.iter_mut().enumerate() {
            *answer = met >> i & 1 == 1;
        }
    }

    #[inline(always)]
    fn of_one(accel: &Accel, stack: &mut Stack, ray: &Ray) -> Self {
        accel.any_of_one(stack, ray, Start::ROOT)
    }
}

impl Accel {
    /// The answer of each ray.
    #[inline(always)]
    pub(super) fn answer_batch<L: Lanes, A: Answer>(
        &self,
        stack: &mut Stack,
        rays: &[Ray],
        answers: &mut [A],
    ) {
        let at_once = PACKETS * LANES;
        for (rays, answers) in rays.chunks(at_once).zip(answers.chunks_mut(at_once)) {
            self.answer_chunk::<L, A>(stack, rays, answers);
        }
    }

    /// The answers of as many rays as make a beam: together if they have enough in common, else packet by
    /// packet, else one by one.
    #[inline(always)]
    fn answer_chunk<L: Lanes, A: Answer>(
        &self,
        stack: &mut Stack,
        rays: &[Ray],
        answers: &mut [A],
    ) {
        let (groups, rest) = rays.as_chunks::<LANES>();
        let (answers, answers_of_rest) = answers.as_chunks_mut::<LANES>();
        self.answer_singly(stack, rest, answers_of_rest);
        let mut packets = ArrayVec::<Packet<L>, PACKETS>::new();
        let mut places = ArrayVec::<usize, PACKETS>::new();
        for (place, rays) in groups.iter().enumerate() {
            let may_share = L::BEAMS && !self.nodes.is_empty();
            match may_share.then(|| Packet::new(rays)).flatten() {
                Some(packet) => {
                    packets.push(packet);
                    places.push(place);
                }
                None => self.answer_singly(stack, rays, &mut answers[place]),
            }
        }
        let mut done = 0;
        if let Ok(beam) = <&mut [_; PACKETS]>::try_from(&mut packets[..]) {
            let alike = beam[1..].iter().all(|packet| packet.runs_like(&beam[0]));
            if alike && self.trace_beam(stack, beam, A::ANY) {
                done = PACKETS;
                for (packet, answers) in beam.iter().zip(answers.iter_mut()) {
                    A::of_packet(self, packet, answers);
                }
            }
        }
        for (packet, place) in packets.iter_mut().zip(places).skip(done) {
            if self.trace_beam(stack, std::array::from_mut(packet), A::ANY) {
                A::of_packet(self, packet, &mut answers[place]);
            } else {
                self.answer_singly(stack, &groups[place], &mut answers[place]);
            }
        }
    }

    #[inline(always)]
    fn answer_singly<A: Answer>(&self, stack: &mut Stack, rays: &[Ray], answers: &mut [A]) {
        for (ray, answer) in rays.iter().zip(answers) {
            *answer = A::of_one(self, stack, ray);
        }
    }
}
