# What accuracy costs in time. Jobs that measure take all cores, so that nothing runs beside them;
# times differ from run to run, counts and errors do not.


rule measure_integrators:
    output:
        "results/costs/integrators/B{B}_k{k}.csv",
    log:
        "results/logs/measure_integrators/B{B}_k{k}.log",
    benchmark:
        "results/benchmarks/measure_integrators/B{B}_k{k}.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: EVERY_CORE
    resources:
        mem_mb=1000,
        runtime=10,
    params:
        code=code_of("measure_integrators"),
        options=STUDY.integrators_options,
    message:
        "time every integrator at B={wildcards.B}, theta0={wildcards.k}π/48"
    shell:
        "sedfiber measure_integrators --B {wildcards.B} --angle-index {wildcards.k} {params.options}"
        " -o {output} > {log} 2>&1"


rule tabulate_costs:
    input:
        cases=lambda wildcards: COST_CASES[wildcards.table],
    output:
        "results/tables/cost_{table}.csv",
    log:
        "results/logs/tabulate_costs/{table}.log",
    benchmark:
        "results/benchmarks/tabulate_costs/{table}.tsv"
    wildcard_constraints:
        table="integrators|model_growth",
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("tabulate_costs"),
    message:
        "put the tables of {wildcards.table} together"
    shell:
        "sedfiber tabulate_costs {input.cases} -o {output} > {log} 2>&1"


rule measure_trajectories:
    output:
        "results/tables/cost_trajectories.csv",
    log:
        "results/logs/measure_trajectories.log",
    benchmark:
        "results/benchmarks/measure_trajectories.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: EVERY_CORE
    resources:
        mem_mb=1000,
        runtime=10,
    params:
        code=code_of("measure_trajectories"),
        options=STUDY.trajectories_options,
    message:
        "time every fall of the study with the default integrator"
    shell:
        "sedfiber measure_trajectories {params.options} -o {output} > {log} 2>&1"


rule measure_discretisation:
    output:
        table="results/tables/cost_discretisation.csv",
        growth="results/tables/cost_growth.csv",
    log:
        "results/logs/measure_discretisation.log",
    benchmark:
        "results/benchmarks/measure_discretisation.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: EVERY_CORE
    resources:
        mem_mb=2000,
        runtime=15,
    params:
        code=code_of("measure_discretisation"),
        beads=config["cost"]["discretisation"]["n_beads"],
    message:
        "time few beads and many, and every mobility"
    shell:
        "sedfiber measure_discretisation --n-beads {params.beads}"
        " -o {output.table} --growth {output.growth} > {log} 2>&1"


# The study trains three neural ODEs for minutes each; here one for every variant, dimension and
# seed, in seconds, on the study's autoencoders.
rule train_short_node:
    input:
        dataset="results/dataset/train.parquet",
        shapes="results/terminal_shapes/train.parquet",
        autoencoder=lambda wildcards: model_files(short_autoencoder(wildcards)),
    output:
        model_files("results/models/short/{variant}_d{dim}_s{seed}"),
    log:
        "results/logs/train_short_node/{variant}_d{dim}_s{seed}.log",
    benchmark:
        "results/benchmarks/train_short_node/{variant}_d{dim}_s{seed}.tsv"
    conda:
        "../../envs/learning.yaml"
    threads: 1
    resources:
        mem_mb=3000,
        runtime=20,
    params:
        code=code_of("train_node"),
        autoencoder=short_autoencoder,
        settings=as_json(STUDY.short_node),
        folder=lambda wildcards, output: Path(output[0]).parent,
    message:
        "train a neural ODE in short: {wildcards.variant}, d={wildcards.dim}, seed {wildcards.seed}"
    shell:
        "sedfiber train_node --dataset {input.dataset} --terminal-shapes {input.shapes}"
        " --autoencoder {params.autoencoder} --recipe rollout --seed {wildcards.seed}"
        " --settings {params.settings:q} -o {params.folder} > {log} 2>&1"


rule measure_models:
    input:
        models=[model_files(folder) for _, _, folder, *_ in COST_MODELS],
        tests=[test_files(split) for split in TEST_SETS],
        reconstruction="results/tables/reconstruction.csv",
        curve="results/terminal_shapes/terminal_curve.parquet",
    output:
        "results/tables/cost_models.csv",
    log:
        "results/logs/measure_models.log",
    benchmark:
        "results/benchmarks/measure_models.tsv"
    conda:
        "../../envs/learning.yaml"
    threads: EVERY_CORE
    resources:
        mem_mb=2000,
        runtime=10,
    params:
        code=code_of("measure_models"),
        models=" ".join("--model " + " ".join(map(str, words)) for words in COST_MODELS),
        tests=" ".join("--test " + " ".join(test_files(split)) for split in TEST_SETS),
    message:
        "time and judge the models of every variant and dimension"
    shell:
        "sedfiber measure_models {params.models} {params.tests} --reconstruction {input.reconstruction}"
        " --terminal-curve {input.curve} -o {output} > {log} 2>&1"


rule measure_choices:
    input:
        models=[model_files(folder) for _, folder, *_ in ASKED_MODELS],
        training=test_files("train"),
        tests=[test_files(split) for split in TEST_SETS],
        curve="results/terminal_shapes/terminal_curve.parquet",
    output:
        table="results/tables/cost_forecast.csv",
        at_each_B="results/tables/cost_choices.csv",
    log:
        "results/logs/measure_choices.log",
    benchmark:
        "results/benchmarks/measure_choices.tsv"
    conda:
        "../../envs/learning.yaml"
    threads: EVERY_CORE
    resources:
        mem_mb=3000,
        runtime=20,
    params:
        code=code_of("measure_choices"),
        models=" ".join("--model " + " ".join(words) for words in ASKED_MODELS),
        tests=" ".join("--test " + " ".join(test_files(split)) for split in TEST_SETS),
        data=[f"results/benchmarks/simulate/B{B}_k{k}.tsv" for B, k in STUDY.runs("train")],
        options=STUDY.choices_options,
    message:
        "time simulations, forecasts, lookup and POD-Galerkin on the test trajectories"
    shell:
        "sedfiber measure_choices --training {input.training} {params.tests} {params.models}"
        " --data-benchmarks {params.data} --terminal-curve {input.curve} {params.options}"
        " -o {output.table} --at-each-B {output.at_each_B} > {log} 2>&1"


rule measure_model_growth:
    output:
        "results/costs/model_growth/N{n_beads}.csv",
    log:
        "results/logs/measure_model_growth/N{n_beads}.log",
    benchmark:
        "results/benchmarks/measure_model_growth/N{n_beads}.tsv"
    wildcard_constraints:
        n_beads=r"\d+",
    conda:
        "../../envs/learning.yaml"
    threads: EVERY_CORE
    resources:
        mem_mb=3000,
        runtime=15,
    params:
        code=code_of("measure_model_growth"),
        options=STUDY.model_growth_options,
        autoencoder=as_json(config["cost"]["model_growth"]["autoencoder"]),
        node=as_json(STUDY.short_node),
    message:
        "simulation against forecast with {wildcards.n_beads} beads"
    shell:
        "sedfiber measure_model_growth --n-beads {wildcards.n_beads} {params.options}"
        " --autoencoder-settings {params.autoencoder:q} --node-settings {params.node:q}"
        " -o {output} > {log} 2>&1"


rule cost:
    input:
        rules.measure_trajectories.output,
        figures_of("cost"),
