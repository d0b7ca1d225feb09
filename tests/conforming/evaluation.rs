//! The evaluation kernel on devices that conform.

use glam::Vec4;
use softbox::device::Batch;
use softbox::effects::{Effect, Effects, Quality};
use softbox::interpret::{Conforming, Interpreter, Sampled, Texels};
use softbox::shade::{LtcSpecular, LtcSurface, ltc_lobe, ltc_three_lobes, ltc_two_lobes};
use softbox::table::Table;

use softbox::stability::{Case, batch};

/// What the evaluation kernel calls for, at a level.
pub fn effects(level: Quality) -> Effects {
    let plain = "quad,polygon,disk,sphere,tube+ggx+two-sided,caps".parse();
    level.of(plain.unwrap_or_else(|error| panic!("{error}")))
}

/// The table of a level, as the kernel reads it.
pub fn table(effects: Effects) -> Table {
    let layers = effects.layers();
    let table = Table::default().completed(&layers);
    if layers.is_empty() { table } else { table.only(&layers) }
}

/// The evaluation kernel with a text of the include, and some cases to evaluate.
pub fn kernel(include: &str, effects: Effects, cases: &[Case]) -> Conforming {
    let source = format!("{include}\n{}", softbox::WGSL_EVALUATE);
    let mut kernel = Conforming::new(&source, "evaluate", effects).unwrap_or_else(|error| panic!("{error}"));
    let Batch { surfaces, lights, vertices, pairs } = batch(cases);
    kernel.bind_buffer(0, bytemuck::cast_slice(&surfaces));
    kernel.bind_buffer(1, bytemuck::cast_slice(&lights));
    kernel.bind_buffer(2, bytemuck::cast_slice(&vertices));
    kernel.bind_buffer(3, bytemuck::cast_slice(&pairs));
    kernel.bind_output(4, 16 * pairs.len());
    let table = table(effects);
    kernel.bind_texels(5, Texels::new(table.size(), &table.bytes()));
    kernel
}

/// The same on the interpreter that counts.
pub fn plain(include: &str, effects: Effects, cases: &[Case]) -> Interpreter {
    let source = format!("{include}\n{}", softbox::WGSL_EVALUATE);
    let mut plain = Interpreter::new(&source, "evaluate", effects).unwrap_or_else(|error| panic!("{error}"));
    let Batch { surfaces, lights, vertices, pairs } = batch(cases);
    plain.bind_buffer(0, bytemuck::cast_slice(&surfaces).to_vec());
    plain.bind_buffer(1, bytemuck::cast_slice(&lights).to_vec());
    plain.bind_buffer(2, bytemuck::cast_slice(&vertices).to_vec());
    plain.bind_buffer(3, bytemuck::cast_slice(&pairs).to_vec());
    plain.bind_buffer(4, vec![0; 16 * pairs.len()]);
    let table = table(effects);
    plain.bind_texels(5, Texels::new(table.size(), &table.bytes()));
    plain
}

/// The lobes of a surface in double precision, from the texels that a device fetched: so the filter's error does not count as one
/// of the arithmetic.
pub fn lobes(surface: &LtcSurface<f64>, effects: Effects, sampled: &[Sampled]) -> Option<LtcSpecular<f64>> {
    let texels: Vec<_> = sampled.iter().map(|sample| Vec4::from(sample.value).as_dvec4()).collect();
    let several = effects.contains(Effect::SecondLobe);
    Some(match texels[..] {
        [shape, amplitude] => LtcSpecular::One(ltc_lobe(surface, shape, amplitude)),
        [first, second, weights] if several => {
            LtcSpecular::Several(ltc_two_lobes(surface, [first, second], weights))
        }
        [first, second, third, albedos, excesses] if several => {
            LtcSpecular::Several(ltc_three_lobes(surface, [first, second, third], albedos, excesses))
        }
        _ => return None,
    })
}
