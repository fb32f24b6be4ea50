//! What `lobe check --help` says beside its arguments.

use lobe::check::Contract;

const EXAMPLES: &str = "\
Examples:
  lobe check scene.toml                                 all materials
  lobe check scene.toml glass --page glass.html         one of them, with plots
  lobe check scene.toml --set 'material.clay={type=\"plastic\"}' --samples 16384
  lobe check scene.toml --image tint.png                grey where all is right
  lobe check --break                                    checks the check, on lobes with planted faults
  lobe check scene.toml | awk '$1 == \"direction\" && $2 == \"clay\" { print $3, $5 }'    albedo over cos

All lobes of a material are checked together, and where there are several, each alone: NAME/1:TYPE and so on. A material
is seen at one point of a flat surface: what textures return elsewhere is not. Exit code 1 if there is a fault.

Each line begins with its kind. `direction` lines have the columns that the first line names, separated by blanks. A blank
within a name is printed as _.
  cos        cosine of the angle to the normal; below 0 from the inner side
  band       r, g or b; all, if the bands are alike
  albedo     fraction of uniform light that is returned, by samples: the mean of f |cos| / pdf
  error      its standard error
  evaluated  the same with f asked at the directions of the samples
  integral   the same as the integral of f |cos|, and specular events
  specular   the part of specular events, which have no f
  density    integral of pdf
  rejected   fraction of sample values that give no direction
  p          probability that samples distributed by pdf fit it as badly; - if rounding changes pdf so much that they
             are not compared, or if almost all events are specular
Factors eta² of refraction are taken out. `ok` lines name a material or lobe without fault; `fault` lines name one, the
contract, where it was seen, and what to look for. A right material has a fault in one of 100 runs (another --seed tells).

With --image, the fraction of uniform light that the surface seen first returns is estimated by its own samples (red), by
f at these, over pdf (green), and by f at cosine-weighted samples of the whole sphere (blue). Each is the mean of the
bands, without factors eta²; specular events are added to all three. What is black hits nothing.";

/// Examples, the output, and all faults.
pub fn text() -> String {
    let fault = |contract: Contract| {
        let (name, meaning, hint) = (contract.name(), contract.meaning(), contract.hint());
        format!("\n  {name:<19}{meaning}\n{:21}to do: {hint}", "")
    };
    let faults: String = Contract::ALL.into_iter().map(fault).collect();
    format!("{EXAMPLES}\n\nFaults:{faults}")
}
