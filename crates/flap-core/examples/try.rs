use flap_core::num::InstructionSet;
use flap_core::simulate::*;
struct J {
    n: u64,
    next: u64,
    base: Vec<f64>,
    rows: Vec<Option<Row>>,
}
impl Jobs for J {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        if self.next == self.n {
            return None;
        }
        let i = self.next;
        self.next += 1;
        Some(Point { index: i, values: self.point(i) })
    }
    fn done(&mut self, index: u64, row: Row) {
        self.rows[index as usize] = Some(row);
    }
}
impl J {
    fn point(&self, i: u64) -> Vec<f64> {
        let mut v = self.base.clone();
        let a = i % 40;
        let b = i / 40;
        v[0] = 40.0 + 1.5 * a as f64;
        v[2] = 95.0 + 0.5 * b as f64;
        v
    }
}
fn main() {
    let (sim, preset) = preset("ozaki2018-large").unwrap();
    let rtol: f64 = std::env::args().nth(2).map_or(1e-6, |s| s.parse().unwrap());
    let st: f64 = std::env::args().nth(3).map_or(1e-6, |s| s.parse().unwrap());
    let solver = SolverSettings { rtol, atol: rtol * 1e-2, settle_tol: st, ..SolverSettings::default() };
    let n: u64 = std::env::args().nth(1).map_or(2000, |s| s.parse().unwrap());
    for set in InstructionSet::available() {
        let mut j = J { n, next: 0, base: (preset.values)(), rows: vec![None; n as usize] };
        let t = std::time::Instant::now();
        sim.run(set, &solver, &mut j);
        let dt = t.elapsed().as_secs_f64();
        let mut evals = 0;
        let mut cyc = 0;
        let mut st = std::collections::BTreeMap::new();
        for r in &j.rows {
            let r = r.as_ref().unwrap();
            evals += r.rhs_evals;
            cyc += r.cycles;
            *st.entry(r.status.name()).or_insert(0) += 1;
        }
        println!(
            "{set}: {dt:.3} s {:.0} pts/s  {:.1} M rhs/s cycles/pt {:.1} {:?}",
            n as f64 / dt,
            evals as f64 / dt * 1e-6,
            cyc as f64 / n as f64,
            st
        );
        let mut res: Vec<f64> =
            j.rows.iter().flatten().filter(|r| r.status == Status::Unsettled).map(|r| r.residual).collect();
        res.sort_by(f64::total_cmp);
        if !res.is_empty() {
            println!(
                "unsettled residual min {:.1e} median {:.1e} p90 {:.1e} max {:.1e}",
                res[0],
                res[res.len() / 2],
                res[res.len() * 9 / 10],
                res[res.len() - 1]
            );
        }
        let m = n.min(200);
        let t = std::time::Instant::now();
        let mut diff = 0;
        for i in 0..m {
            let r = sim.run_point(set, &solver, &j.point(i));
            let a = j.rows[i as usize].as_ref().unwrap();
            if format!("{a:?}") != format!("{r:?}") {
                if diff == 0 {
                    println!("{a:?}\n{r:?}");
                }
                diff += 1;
            }
        }
        let ds = t.elapsed().as_secs_f64();
        println!("   scalar {:.0} pts/s, {diff} differ", m as f64 / ds);
    }
    let r = sim.run_point(
        InstructionSet::best(),
        &SolverSettings { rtol: 1e-8, atol: 1e-10, settle_tol: 1e-9, ..solver },
        &(preset.values)(),
    );
    for (c, v) in sim.columns().iter().zip(&r.measures) {
        println!("{:30} {v}", c.name);
    }
    println!("{:?} {} {} {}", r.status, r.cycles, r.residual, r.rhs_evals);
}
#[allow(dead_code)]
fn unused() {}
