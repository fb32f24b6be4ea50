//! [`Batch`]: a slice of rays, traced as beams where they have enough in common.

use arrayvec::ArrayVec;

use super::beam::trace_beam;
use super::frustum::MAX_PACKETS;
use super::packet::Packet;
use super::single_ray::{AnyHit, ClosestHit, Start};
use super::space::World;
use super::stack::Stack;
use crate::accel::tree::Bvh;
use crate::geometry::Ray;
use crate::interaction::Hit;
use crate::simd::{Kernel, LANES, Lanes};

/// What a batch is asked for: [`Hit`] for the closest hit of each ray, `bool` for whether it hits anything.
pub trait Answer: Sized {
    /// Whether any hit of a ray will do, not only the closest.
    const ANY: bool;
    /// The answers of a packet that was traced.
    fn of_packet<L: Lanes>(bvh: &Bvh, packet: &Packet<L>, answers: &mut [Self; LANES]);
    /// Traces a ray by itself.
    fn trace<L: Lanes>(&mut self, bvh: &Bvh, stack: &mut Stack, ray: &Ray);
}

impl Answer for Hit {
    const ANY: bool = false;

    #[inline(always)]
    fn of_packet<L: Lanes>(bvh: &Bvh, packet: &Packet<L>, answers: &mut [Self; LANES]) {
        packet.hits(bvh, answers);
    }

    #[inline(always)]
    fn trace<L: Lanes>(&mut self, bvh: &Bvh, stack: &mut Stack, ray: &Ray) {
        *self = Self::MISS;
        L::call(bvh, stack, ray, ClosestHit { space: World, start: Start::ROOT, hit: self });
        bvh.tell_shape(self);
    }
}

impl Answer for bool {
    const ANY: bool = true;

    #[inline(always)]
    fn of_packet<L: Lanes>(_: &Bvh, packet: &Packet<L>, answers: &mut [Self; LANES]) {
        let rays = packet.any_hit();
        for (i, answer) in answers.iter_mut().enumerate() {
            *answer = rays >> i & 1 == 1;
        }
    }

    #[inline(always)]
    fn trace<L: Lanes>(&mut self, bvh: &Bvh, stack: &mut Stack, ray: &Ray) {
        *self = L::call(bvh, stack, ray, AnyHit(World, Start::ROOT));
    }
}

/// The answer of each ray of a slice.
pub struct Batch<'a, A> {
    /// As many as rays.
    pub answers: &'a mut [A],
}

impl<A: Answer> Kernel for Batch<'_, A> {
    type Input = [Ray];
    type Data = Bvh;
    type Scratch = Stack;
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, rays: &[Ray], bvh: &Bvh, stack: &mut Stack) {
        let chunk = MAX_PACKETS * LANES;
        for (rays, answers) in rays.chunks(chunk).zip(self.answers.chunks_mut(chunk)) {
            trace_chunk::<L, A>(bvh, stack, rays, answers);
        }
    }
}

/// Answers up to as many rays as make a beam: as one beam if they have enough in common, else packet by packet, else ray
/// by ray.
#[inline(always)]
fn trace_chunk<L: Lanes, A: Answer>(bvh: &Bvh, stack: &mut Stack, rays: &[Ray], answers: &mut [A]) {
    let (groups, rest) = rays.as_chunks::<LANES>();
    let (answers, answers_of_rest) = answers.as_chunks_mut::<LANES>();
    trace_singly::<L, A>(bvh, stack, rest, answers_of_rest);
    let mut packets = ArrayVec::<Packet<L>, MAX_PACKETS>::new();
    let mut group_of_packet = ArrayVec::<usize, MAX_PACKETS>::new();
    for (group, rays) in groups.iter().enumerate() {
        match (!bvh.nodes.is_empty()).then(|| Packet::new(rays)).flatten() {
            Some(packet) => {
                packets.push(packet);
                group_of_packet.push(group);
            }
            None => trace_singly::<L, A>(bvh, stack, rays, &mut answers[group]),
        }
    }
    let mut done = 0;
    if let Ok(beam) = <&mut [_; MAX_PACKETS]>::try_from(&mut packets[..]) {
        let is_aligned = beam[1..].iter().all(|packet| packet.is_aligned_with(&beam[0]));
        if is_aligned && trace_beam(bvh, stack, beam, A::ANY) {
            done = MAX_PACKETS;
            for (packet, answers) in beam.iter().zip(answers.iter_mut()) {
                A::of_packet(bvh, packet, answers);
            }
        }
    }
    for (packet, group) in packets.iter_mut().zip(group_of_packet).skip(done) {
        if trace_beam(bvh, stack, std::array::from_mut(packet), A::ANY) {
            A::of_packet(bvh, packet, &mut answers[group]);
        } else {
            trace_singly::<L, A>(bvh, stack, &groups[group], &mut answers[group]);
        }
    }
}

#[inline(always)]
fn trace_singly<L: Lanes, A: Answer>(
    bvh: &Bvh,
    stack: &mut Stack,
    rays: &[Ray],
    answers: &mut [A],
) {
    for (ray, answer) in rays.iter().zip(answers) {
        answer.trace::<L>(bvh, stack, ray);
    }
}
