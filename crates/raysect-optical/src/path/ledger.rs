/// What has become of paths: everything that was sent out is absorbed, has escaped, or is named here.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ledger {
    /// Paths followed.
    pub paths: u64,
    /// Rays traced for them, shadow rays not counted.
    pub rays: u64,
    /// Rays traced towards lights.
    pub shadow_rays: u64,
    /// Paths that have brought light, wherever they ended.
    pub collected: u64,
    /// Paths that ended on a surface.
    pub absorbed: u64,
    /// Paths that left the scene.
    pub escaped: u64,
    /// Paths ended by roulette, which the survivors make up for.
    pub killed: u64,
    /// Paths ended by `max_depth`, which nothing makes up for.
    pub truncated: u64,
    /// The sum of the throughputs that they still had: divided by `paths`, a bound on the share of light that is
    /// missing from an enclosure of unit radiance.
    pub truncated_throughput: f64,
    /// Paths given up between transparent surfaces, or in a medium without end.
    pub lost: u64,
    /// Times at which the surfaces passed did not agree with the media that a path was in.
    pub inconsistencies: u64,
    /// Places at which a line integral was given up before it reached its tolerance, or a medium attenuated more than
    /// the bound that it had declared.
    pub unresolved: u64,
    /// Times at which a path came into two refracting volumes of equal priority at once: which of them counts follows
    /// from the order of their nodes.
    pub contested: u64,
    /// The two of them, by the numbers of their instances: of all pairs that were met the first in order.
    pub contestants: Option<[u32; 2]>,
}

/// How many numbers a ledger is in a block of results.
pub const LEDGER_NUMBERS: usize = 15;

/// What stands for an instance in a block of results where there is none.
const NOBODY: f64 = -1.0;

impl Ledger {
    /// The ledger as plain numbers, exact below 2⁵³.
    pub fn to_numbers(&self) -> [f64; LEDGER_NUMBERS] {
        [
            self.paths as f64,
            self.rays as f64,
            self.shadow_rays as f64,
            self.absorbed as f64,
            self.escaped as f64,
            self.killed as f64,
            self.truncated as f64,
            self.truncated_throughput,
            self.lost as f64,
            self.inconsistencies as f64,
            self.unresolved as f64,
            self.contested as f64,
            self.contestants.map_or(NOBODY, |pair| f64::from(pair[0])),
            self.contestants.map_or(NOBODY, |pair| f64::from(pair[1])),
            self.collected as f64,
        ]
    }

    /// Adds a ledger given as plain numbers.
    pub fn add_numbers(&mut self, n: &[f64; LEDGER_NUMBERS]) {
        self.paths += n[0] as u64;
        self.rays += n[1] as u64;
        self.shadow_rays += n[2] as u64;
        self.absorbed += n[3] as u64;
        self.escaped += n[4] as u64;
        self.killed += n[5] as u64;
        self.truncated += n[6] as u64;
        self.truncated_throughput += n[7];
        self.lost += n[8] as u64;
        self.inconsistencies += n[9] as u64;
        self.unresolved += n[10] as u64;
        self.contested += n[11] as u64;
        self.collected += n[14] as u64;
        if n[12] != NOBODY {
            self.name_contestants([n[12] as u32, n[13] as u32]);
        }
    }

    /// Notes a pair of contestants, if it comes before the one that is known: the answer does not depend on the order
    /// in which paths are followed.
    pub(super) fn name_contestants(&mut self, pair: [u32; 2]) {
        self.contestants = Some(self.contestants.map_or(pair, |known| known.min(pair)));
    }
}
