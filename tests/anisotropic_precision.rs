//! Sharp anisotropic lobes in single precision, at the angles where their matrix is all but singular.

use core::f64::consts::TAU;

use glam::DVec3;
use softbox::effects::Effects;
use softbox::shade::{
    LtcMaterial, Real, Vector, ltc_anisotropic_alpha, ltc_anisotropy, ltc_material, ltc_reflected,
    ltc_shading, ltc_shading_quad, ltc_surface,
};
use softbox::stability::Random;
use softbox::table::{AnisotropicTable, Table};

/// A surface of single-precision numbers and a quad.
#[derive(Debug)]
struct Case {
    normal: DVec3,
    view: DVec3,
    grain: DVec3,
    anisotropy: f64,
    roughness: f64,
    corners: [DVec3; 4],
}

impl Case {
    fn new(roughness: f32, cosine: f64, random: &mut Random) -> Self {
        let single = |v: DVec3| v.as_vec3().as_dvec3();
        let normal = random.direction();
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let azimuth = random.between(0.0, TAU);
        let along = tangent * azimuth.cos() + bitangent * azimuth.sin();
        let centre = random.direction() * random.log(0.5, 4.0);
        let (x, y) = (random.direction(), random.direction());
        Self {
            normal: single(normal),
            view: single(along * f64::sqrt(1.0 - cosine * cosine) + normal * cosine),
            grain: single(random.direction()),
            anisotropy: f64::from(random.unit() as f32),
            roughness: f64::from(roughness),
            corners: [centre - x - y, centre + x - y, centre + x + y, centre - x + y].map(single),
        }
    }

    /// What the surface reflects of a quad of unit radiance.
    fn reflected<R: Real>(&self, table: &Table, anisotropy: f64, effects: Effects) -> f64 {
        let v = |v: DVec3| R::Vec3::new(R::new(v.x), R::new(v.y), R::new(v.z));
        let plain = ltc_material::<R>(v(DVec3::ZERO), R::new(self.roughness), v(DVec3::ONE));
        let material = LtcMaterial { anisotropy: R::new(anisotropy), grain: v(self.grain), ..plain };
        let shading = ltc_shading(v(DVec3::ZERO), v(self.normal), v(self.view), &material, table, effects);
        let received = ltc_shading_quad(&shading, self.corners.map(v), true);
        ltc_reflected(&shading, &material, &received).x().to_f64()
    }
}

/// Every setting, with some random cases each.
fn each_setting(mut check: impl FnMut(f32, f64, &[Case])) {
    let mut random = Random::new(5);
    for roughness in [0.02, 0.05, 0.2, 0.5] {
        for cosine in [0.1, 1e-2, 1e-3, 1e-4, 1e-6, 0.0, -0.3] {
            let cases: Vec<Case> = (0..2000).map(|_| Case::new(roughness, cosine, &mut random)).collect();
            check(roughness, cosine, &cases);
        }
    }
}

/// The stretch and what is stretched differ by 1 / alpha: taken in any plane but that of the view's azimuth, nearly all light is
/// lost or found.
#[test]
fn sharp_lobes_at_grazing_angles_keep_their_digits() {
    let effects: Effects = "quad+ggx,anisotropic".parse().unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default().with(&Table::sheen()).with(&Table::diffuse());
    let table = table.with(AnisotropicTable::default().layers());
    each_setting(|roughness, cosine, cases| {
        // Seen along the surface or from below, rounding moves vertices by a share of the lobe's height.
        let bound = if cosine > 0.0 { 1.5e-4 } else { 3e-3 };
        let mut worst = [0.0_f64; 2];
        for case in cases {
            for (at, anisotropy) in [case.anisotropy, 0.0].into_iter().enumerate() {
                let single = case.reflected::<f32>(&table, anisotropy, effects);
                let exact = case.reflected::<f64>(&table, anisotropy, effects);
                let difference = (single - exact).abs();
                assert!(
                    difference < bound,
                    "{single}, not {exact}, within {bound}: anisotropy {anisotropy} of {case:?}"
                );
                worst[at] = worst[at].max(difference);
            }
        }
        println!("roughness {roughness}, cosine {cosine}: {:.1e}, isotropic {:.1e}", worst[0], worst[1]);
    });
}

/// Exact arithmetic has no lobe that mirrors, so taking the determinant without its sign hides nothing.
#[test]
fn no_lobe_is_mirrored() {
    let (table, anisotropic) = (Table::default(), AnisotropicTable::default());
    let mut least = f64::INFINITY;
    each_setting(|_, _, cases| {
        for case in cases {
            let surface = ltc_surface::<f64>(DVec3::ZERO, case.normal, case.view, case.roughness);
            let [x, y]: [f64; 2] = ltc_anisotropic_alpha::<f64>(case.roughness, case.anisotropy).into();
            let anisotropy = ltc_anisotropy::<f64>(&surface, case.grain, x, y);
            let lobe = anisotropic.lobe(&table, &surface, &anisotropy);
            // The axes are cofactors of the matrix whose columns are along the normals: the product of one with its own has the sign of
            // the determinant.
            let [x, z] = [lobe.normal_x.dot(lobe.axis_x), lobe.normal_z.dot(lobe.axis_z)];
            least = least.min(x).min(z);
            assert!(x > 0.0 && z > 0.0, "{x} and {z}: {case:?}");
        }
    });
    println!("least {least:.1e}");
}
