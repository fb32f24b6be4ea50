//! The instruction sets that rays are traced with: their names, and trees that are built for one.

use lobe::accel::{Accel, InstructionSet, InstructionSetError};

use super::answers::{Loop, assert_single};
use super::kinds::{Kind, many};
use crate::common::meshes::{grid, lumpy};

/// What a name reads as: the instruction set, or that the processor lacks it. Caught: `avx2` read as another set; a name
/// written without its width.
#[test]
fn names_are_read_back() {
    let available = InstructionSet::available();
    assert_eq!(available[0], InstructionSet::PORTABLE);
    assert_eq!(available.last(), Some(&InstructionSet::fastest()));
    assert_eq!(InstructionSet::default(), InstructionSet::fastest());
    for name in ["portable", "avx2", "avx512"] {
        match (name.parse::<InstructionSet>(), available.iter().find(|set| set.name() == name)) {
            (Ok(set), Some(expected)) => assert_eq!(set, *expected),
            (Err(InstructionSetError::Unavailable(lacks)), None) => assert_eq!(lacks, name),
            (parsed, found) => panic!("{name}: {parsed:?}, {found:?}"),
        }
    }
    for set in available {
        assert_eq!((set.to_string(), format!("{set:>9}").len()), (set.name().to_owned(), 9));
    }
}

/// Messages name what is possible. Caught: a list that leaves `portable` out; names taken in any case.
#[test]
fn messages_name_what_is_possible() {
    for name in ["", "AVX2", "avx-512", " avx2", "sse2"] {
        let error = name.parse::<InstructionSet>().unwrap_err().to_string();
        let expected =
            format!("unknown instruction set {name:?}: expected portable, avx2 or avx512");
        assert_eq!(error, expected);
    }
    let names: Vec<_> = InstructionSet::available().iter().map(|set| set.name()).collect();
    let error = InstructionSetError::Unavailable("avx512").to_string();
    let expected = format!("this processor does not have avx512: it has {}", names.join(", "));
    assert_eq!(error, expected);
}

/// A tree that is built for an instruction set is traced with it, and gives what the loop gives. Caught: the fastest
/// taken whatever is asked for.
#[test]
fn trees_for_each_instruction_set_give_the_same() {
    let meshes = [lumpy(3, 24), grid(8)];
    let truth = Loop::new(&meshes);
    for set in InstructionSet::available() {
        let accel = Accel::build_for(set, &meshes);
        assert_eq!(accel.instruction_set(), set);
        for kind in Kind::ALL {
            for (trial, ray) in many(kind, &meshes, 77, 60).iter().enumerate() {
                let what = format!("{set}, {kind:?}, trial {trial}");
                assert_single(&accel, ray, &truth.closest(ray), &what);
            }
        }
    }
}
