//! Every term books its work: what the ledger leaves open is the length of a step. (That no wall at rest feeds the flow is
//! what the case `water-column` is about.)

use crate::invariants::fields;
use crate::invariants::patches::{
    DENSITY, Disorder, EQUATION_OF_STATE, GRAINS, SPACING, SYRUP, bed, block, periodic_scene, simulation,
};
use crate::invariants::pore_liquid;
use bagnold_harness::observation::EnergyBook;
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::energy::{EnergyAccount, EnergyLedger};
use bagnold_solver::weakly_compressible::numerics::{Contact, Numerics};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::{SideWalls, wall};

const STEPS: usize = 100;

/// Residual after the steps over what was dissipated meanwhile, with a share of the longest acoustic step.
fn open_share<const D: usize>(scene: Scene<D>, courant: f64) -> f64
where
    Simulation<D>: Compiled<D>,
{
    let numerics = Numerics { acoustic_courant: courant, ..scene.numerics };
    let mut simulation = simulation(Scene { numerics, ..scene });
    let start = simulation.energy().expect("the single divergence keeps a ledger");
    for _ in 0..(STEPS as f64 * 0.4 / courant) as usize {
        simulation.step().expect("a stable step");
    }
    let end = simulation.energy().expect("the same");
    assert!(end.ledger.dissipated() > 0.0, "nothing was dissipated");
    end.residual_since(&start) / end.ledger.dissipated()
}

#[test]
fn a_disordered_block_loses_what_its_terms_dissipate() {
    for rheology in
        [GRAINS, fields::nonlocal(), pore_liquid::submerged(), Rheology::Newtonian(Newtonian { viscosity: 5.0 })]
    {
        let plane = |courant| open_share(Scene { rheology, ..periodic_scene([17, 14], Disorder::FULL, 11) }, courant);
        let space = open_share(Scene { rheology, ..periodic_scene([8, 7, 9], Disorder::FULL, 11) }, 0.1);
        let (long, short) = (plane(0.4), plane(0.1));
        println!("{rheology:?}: {long:.4} and {short:.4} in the plane, {space:.4} in space");
        assert!(short.abs() < 0.02 && space.abs() < 0.02, "{short}, {space}");
        // of first order: a quarter of the step leaves a quarter open, and something more for the noise of another path
        assert!(short.abs() < 0.4 * long.abs(), "{long} should fall with the step to a quarter, not {short}");
    }
}

/// Largest residual of cases and scenes over the largest work `[-]`.
const OPEN: f64 = 0.005;

/// Every term of the scheme off, and short steps.
fn bare() -> Numerics {
    Numerics {
        acoustic_courant: 0.02,
        viscous_courant: 0.005,
        density_coupling: 0.0,
        artificial_viscosity: 0.0,
        hourglass: 0.0,
        stress_diffusion: 0.0,
        elastic_damping: 0.0,
        ..Numerics::default()
    }
}

/// Twenty accounts of a run, evenly over its time `[s]`.
fn accounts(scene: Scene<2>, end: f64) -> Vec<(f64, EnergyAccount)> {
    let mut simulation = simulation(scene);
    let mut accounts = Vec::new();
    for sample in 0..=20 {
        while simulation.time() < end * f64::from(sample) / 20.0 {
            simulation.step().expect("a stable step");
        }
        accounts.push((simulation.time(), simulation.energy().expect("the single divergence keeps a ledger")));
    }
    accounts
}

/// Residual over the largest work, if the ledger has an error.
fn open(accounts: &[(f64, EnergyAccount)], error: impl Fn(&mut EnergyLedger)) -> f64 {
    let mut book = EnergyBook::default();
    for (time, account) in accounts {
        let mut wrong = *account;
        error(&mut wrong.ledger);
        book.enter(*time, &wrong, 0.0);
    }
    book.residual() / book.turnover()
}

/// A block on a bed, periodic across, that moves along it with a speed `[m/s]`.
fn on_a_bed(cells: [usize; 2], rheology: Rheology, speed: f64, numerics: Numerics) -> Scene<2> {
    let mut scene = periodic_scene(cells, Disorder { jitter: 0.05, ..Disorder::NONE }, 5);
    scene.domain.axes[1] = AxisBoundary::Open;
    scene.walls = vec![bed()];
    let extent = (Vector::zeros(), Vector::repeat(25.0 * SPACING));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, SPACING, 4);
    scene.gravity[1] = -9.81;
    scene.flow.velocity.fill(Vector::<2>::new(speed, 0.0));
    for (position, density) in scene.flow.position.iter().zip(&mut scene.flow.density) {
        *density = EQUATION_OF_STATE.density(DENSITY * 9.81 * (cells[1] as f64 * SPACING - position[1]));
    }
    Scene { rheology, numerics, ..scene }
}

/// A run for each entry, in which no other is larger; but for the control at walls, which never is.
#[test]
fn an_error_of_one_per_cent_in_any_entry_is_noticed() {
    let water = Rheology::Newtonian(Newtonian { viscosity: 1e-6 });
    let disorder = Disorder { speed: 0.1, ..Disorder::FULL };
    let block = |rheology, numerics| Scene { rheology, numerics, ..periodic_scene([17, 14], disorder, 11) };
    let slope = {
        let mut scene = on_a_bed([12, 8], SYRUP, 0.0, bare());
        scene.gravity[0] = 5.0;
        scene
    };
    let belt = {
        let mut scene = on_a_bed([12, 8], SYRUP, 0.0, bare());
        scene.walls[0].velocity[0] = 1.0;
        scene
    };
    let drop = {
        let mut scene = on_a_bed([12, 1], water, 0.0, bare());
        scene.flow.density.fill(DENSITY);
        scene.flow.position.iter_mut().for_each(|position| position[1] += 5.0 * SPACING);
        // the plane alone, so that nothing but the contact stops the row
        scene.wall_particles.clear();
        scene
    };
    type Entry = fn(&mut EnergyLedger) -> &mut f64;
    let narrow = {
        let mut scene = block(GRAINS, bare());
        scene.flow.velocity.iter_mut().for_each(|velocity| velocity[0] += 1.0);
        scene.side_walls = Some(SideWalls { width: 0.01, friction: 0.5 });
        scene
    };
    let runs: [(&str, Scene<2>, f64, Entry); 8] = [
        ("gravity", slope, 0.1, |ledger| &mut ledger.gravity),
        ("walls", belt, 0.1, |ledger| &mut ledger.walls),
        ("viscous", block(SYRUP, Numerics { acoustic_courant: 0.004, ..bare() }), 0.02, |ledger| &mut ledger.viscous),
        ("plastic", block(GRAINS, bare()), 0.02, |ledger| &mut ledger.plastic),
        ("artificial", block(water, Numerics { artificial_viscosity: 1.0, ..bare() }), 0.02, |ledger| {
            &mut ledger.artificial
        }),
        ("density coupling", block(water, Numerics { density_coupling: 1.0, ..bare() }), 0.02, |ledger| {
            &mut ledger.density_coupling
        }),
        ("contacts", drop, 0.15, |ledger| &mut ledger.contact),
        ("side walls", narrow, 0.02, |ledger| &mut ledger.side_walls),
    ];
    for (name, scene, end, entry) in runs {
        let accounts = accounts(scene, end);
        let sound = open(&accounts, |_| ());
        let wrong = [0.99, 1.01].map(|factor| open(&accounts, |ledger| *entry(ledger) *= factor));
        println!("{name}: {sound:.5} open, {wrong:.5?} with an error of one per cent");
        let mut ledger = accounts[20].1.ledger;
        assert!(sound < 0.5 * OPEN, "{name}: {sound}");
        assert!(wrong[0] > OPEN && wrong[1] > OPEN, "{name}: {wrong:?} of {}", entry(&mut ledger));
    }
}

/// A block that comes with its energy and loses a part of it: of what came in, one per cent is noticed in whatever entry it is.
#[test]
fn an_error_of_one_per_cent_of_what_moves_at_the_start_is_noticed() {
    let water = Rheology::Newtonian(Newtonian { viscosity: 1e-6 });
    let disorder = Disorder { speed: 0.1, ..Disorder::FULL };
    let mut scene = Scene { rheology: water, numerics: bare(), ..periodic_scene([17, 14], disorder, 11) };
    scene.flow.velocity.iter_mut().for_each(|velocity| velocity[0] += 1.0);
    let accounts = accounts(scene, 0.02);
    let brought = accounts[0].1.kinetic;
    assert!(open(&accounts, |_| ()) < 0.5 * OPEN);
    let entries: [fn(&mut EnergyLedger) -> &mut f64; 12] = [
        |ledger| &mut ledger.gravity,
        |ledger| &mut ledger.walls,
        |ledger| &mut ledger.viscous,
        |ledger| &mut ledger.plastic,
        |ledger| &mut ledger.artificial,
        |ledger| &mut ledger.wall_control,
        |ledger| &mut ledger.density_coupling,
        |ledger| &mut ledger.contact,
        |ledger| &mut ledger.side_walls,
        |ledger| &mut ledger.correction,
        |ledger| &mut ledger.cut,
        |ledger| &mut ledger.ways,
    ];
    for (number, entry) in entries.into_iter().enumerate() {
        for sign in [-1.0, 1.0] {
            let end = accounts[20].1.ledger;
            let wrong = open(&accounts, |ledger| {
                if *ledger == end {
                    *entry(ledger) += sign * 0.01 * brought;
                }
            });
            assert!(wrong > OPEN, "entry {number}: {wrong}");
        }
    }
}

/// Its share of all work stays below a tenth, so that the limit of a run cannot hold it. That of a step without length can.
#[test]
fn the_control_at_walls_is_booked_to_one_per_cent_of_itself() {
    let water = Rheology::Newtonian(Newtonian { viscosity: 1e-6 });
    let noisy = |courant| {
        let numerics = Numerics { hourglass: 1.0, contact: Contact::None, acoustic_courant: courant, ..bare() };
        let mut scene = on_a_bed([12, 2], water, 0.0, numerics);
        scene.flow.velocity = block([12, 2], Disorder { speed: 0.2, ..Disorder::NONE }, 7).velocity;
        let accounts = accounts(scene, 0.002);
        let (start, end) = (accounts[0].1, accounts[20].1);
        println!("{:?}", end.ledger);
        (end.residual_since(&start), end.ledger.wall_control)
    };
    let (long, short) = (noisy(0.01), noisy(0.005));
    let open = (2.0 * short.0 - long.0) / short.1;
    println!("{:.5} and {:.5} of it open, {open:.5} in the limit", long.0 / long.1, short.0 / short.1);
    assert!(open.abs() < 0.005, "{open}");
}
