//! The instructions that a piece of work executes: counted by single steps, named by `objdump`.

use std::collections::HashMap;
use std::io;
use std::process::Command;

use nix::sys::ptrace;

use crate::counter::count;

/// Instructions executed.
#[derive(Default)]
pub(crate) struct Executed {
    pub(crate) all: u64,
    /// Fused multiplications and additions of vectors.
    pub(crate) fused: u64,
    /// Additions, multiplications, minima and maxima of vectors.
    pub(crate) simple: u64,
    /// Divisions and square roots of vectors.
    pub(crate) divisions: u64,
    /// With an operand in the stack's memory.
    pub(crate) stack: u64,
}

impl Executed {
    /// Arithmetic of vectors.
    pub(crate) fn arithmetic(&self) -> u64 {
        self.fused + self.simple + self.divisions
    }

    /// The instructions of a child process that does this work.
    pub(crate) fn of(work: &str) -> io::Result<Executed> {
        let mut times: HashMap<u64, u64> = HashMap::new();
        let mut base = None;
        let all = count(work, &mut |child| {
            if base.is_none() {
                base = Some(program_base(child.as_raw())?);
            }
            let address = ptrace::getregs(child)?.rip;
            *times.entry(address.wrapping_sub(base.unwrap_or(0))).or_default() += 1;
            Ok(())
        })?;
        let mut executed = Executed { all, ..Executed::default() };
        for line in disassembly()?.lines() {
            let Some((address, instruction)) = line.split_once(":\t") else { continue };
            let Ok(address) = u64::from_str_radix(address.trim(), 16) else { continue };
            if let Some(times) = times.get(&address) {
                executed.add(instruction, *times);
            }
        }
        Ok(executed)
    }

    fn add(&mut self, instruction: &str, times: u64) {
        if instruction.contains("(%rsp") || instruction.contains("(%rbp") {
            self.stack += times;
        }
        let name = instruction.split_whitespace().next().unwrap_or_default();
        // Packed numbers of double precision.
        let Some(operation) = name.strip_prefix('v').and_then(|name| name.strip_suffix("pd")) else { return };
        match operation {
            "add" | "sub" | "mul" | "min" | "max" => self.simple += times,
            "div" | "sqrt" => self.divisions += times,
            _ if operation.starts_with("fm") || operation.starts_with("fnm") => self.fused += times,
            _ => {}
        }
    }
}

/// The address at which the program has been loaded.
fn program_base(child: i32) -> io::Result<u64> {
    let maps = std::fs::read_to_string(format!("/proc/{child}/maps"))?;
    let first = maps.split('-').next().unwrap_or_default();
    u64::from_str_radix(first, 16).map_err(io::Error::other)
}

fn disassembly() -> io::Result<String> {
    let program = std::env::current_exe()?;
    let said = Command::new("objdump").args(["-d", "--no-show-raw-insn"]).arg(program).output()?;
    Ok(String::from_utf8_lossy(&said.stdout).into_owned())
}
